# Draws a chart of plugray. What it shows comes from settings.gp and from the data files beside it:
# curve-ROW-METHOD, labels-ROW-METHOD, under-ROW-METHOD (where a curve meets the floor), front-ROW-COLUMN, chosen-ROW-0.
# Rows are errors, columns times.
set encoding utf8
load 'settings.gp'
if (picture eq 'svg') {
    set terminal svg noenhanced size 1080,960 font 'sans-serif,13' background '#ffffff'
    small = ',11'
    tiny = ',9'
} else {
    set terminal pngcairo noenhanced size 1080,960 font 'sans,11' background '#ffffff'
    small = ',9'
    tiny = ',7'
}
set output 'chart'
# colours that people with any vision tell apart (Okabe and Ito), and marks that need no colour
colors = '#0072b2 #d55e00 #009e73 #cc79a7 #56b4e9 #e69f00'
marks = '5 9 7 13 11 15'
# where labels stand beside their points: curves fall from the left to the right
right = '1.4 -1.4 -2.0 3.0 -1.4 1.4'
above = '0.6 -0.6 -1.3 1.3 -0.6 0.6'
color(i) = word(colors, 1 + i % 6)
mark(i) = int(word(marks, 1 + i % 6))
style(m) = int(value(sprintf('style_%d', m)))

set multiplot
unset key
set label 1 title_text at screen 0.5,0.975 center font ',16'
set label 2 machine_text at screen 0.5,0.95 center font small
set label 3 repeat_text at screen 0.5,0.93 center font small
set label 4 reference_text at screen 0.02,0.042 left font small
set label 5 chosen_text at screen 0.02,0.02 left font small
set logscale xy
set grid lc '#e4e4e4' lt 1 lw 0.6
set border 3 lc '#444444'
set tics nomirror out font small

do for [row = 0:1] {
    do for [column = 0:1] {
        set lmargin at screen (column ? 0.575 : 0.085)
        set rmargin at screen (column ? 0.98 : 0.49)
        set tmargin at screen (row ? 0.445 : 0.845)
        set bmargin at screen (row ? 0.13 : 0.53)
        eval sprintf("set xrange [time_from_%d:time_to_%d]", column, column)
        eval sprintf("set yrange [error_from_%d:error_to_%d]", row, row)
        eval sprintf("set xtics (%s)", value(sprintf("time_marks_%d", column)))
        eval sprintf("set ytics (%s)", value(sprintf("error_marks_%d", row)))
        eval sprintf("set xlabel time_label_%d", column)
        set label 8 value(sprintf('error_label_%d', row)) at graph -0.16, graph 0.5 center rotate
        eval sprintf("floor_now = floor_%d", row)
        set object 1 rectangle from graph 0, graph 0 to graph 1, first floor_now behind fc rgb '#ececec' fs solid noborder
        set label 6 'below what the reference can tell' at graph 0.01, first floor_now left offset 0,-0.6 font tiny tc rgb '#666666'
        if (row) {
            set label 7 asked_text at graph 0.01, first asked left offset 0,0.5 font tiny tc rgb '#666666'
        }
        plot sprintf('front-%d-%d', row, column) using 1:2 with steps lw 7 lc rgb '#d8d8d8' notitle, \
            floor_now with lines lw 1 lc rgb '#999999' notitle, \
            (row ? asked : NaN) with lines dt 2 lw 1 lc rgb '#999999' notitle, \
            for [m = 0:methods-1] sprintf('curve-%d-%d', row, m) using (column(column+1)):3 with linespoints \
                lw 1.6 pt mark(style(m)) ps 0.6 lc rgb color(style(m)) notitle, \
            for [m = 0:methods-1] sprintf('under-%d-%d', row, m) using (column(column+1)):3 with points \
                pt 10 ps 0.9 lc rgb color(style(m)) notitle, \
            for [m = 0:methods-1] sprintf('labels-%d-%d', row, m) using (column(column+1)):3:4 with labels \
                font tiny offset 1.0*word(right, 1 + style(m) % 6),1.0*word(above, 1 + style(m) % 6) tc rgb color(style(m)) notitle, \
            sprintf('chosen-%d-0', row) using (column(column+1)):3 with points pt 6 ps 1.8 lw 1.6 lc rgb '#000000' notitle
        unset label 7
        unset for [i = 1:5] label i
    }
}

# the legend: a strip of its own
unset logscale
unset border
unset tics
unset grid
unset xlabel
unset object 1
unset label 6
unset label 8
set lmargin at screen 0.04
set rmargin at screen 0.98
set tmargin at screen 0.92
set bmargin at screen 0.855
set xrange [0:1]
set yrange [0:1]
set key at graph 0.5, graph 0.5 center center horizontal maxrows 2 samplen 2 width 1 font small
plot for [m = 0:methods-1] NaN with linespoints lw 1.6 pt mark(style(m)) ps 0.6 lc rgb color(style(m)) \
        title value(sprintf('method_%d', m)), \
    NaN with points pt 6 ps 1.8 lw 1.6 lc rgb '#000000' title "the planner's choice", \
    NaN with lines lw 7 lc rgb '#d8d8d8' title 'Pareto front', \
    NaN with lines lw 1 lc rgb '#999999' title '3 times the error of the reference'
unset multiplot
