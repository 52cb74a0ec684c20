#!/bin/bash
# Installs the build into a folder of its own and builds the example with a plain Makefile through
# pkg-config: installed.sh BUILD SOURCE
set -uo pipefail
build=$1 source=$2
count=0 failed=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

check() { # name, command...
    local name=$1
    shift
    count=$((count + 1))
    if "$@" >"$work/log" 2>&1; then
        echo "ok $count - $name"
    else
        failed=1
        echo "not ok $count - $name"
        tail -n 20 "$work/log" | sed 's/^/#   /'
    fi
}

check 'the build installs' env DESTDIR="$work/tree" meson install -C "$build" --no-rebuild
pc=$(find "$work/tree" -name plugray-plugs.pc)
library=$(find "$work/tree" -name libplugray-plugs.so)
whole=$(find "$work/tree" -name libplugray.so)
libraries=$(dirname "$library")
export PKG_CONFIG_SYSROOT_DIR=$work/tree PKG_CONFIG_PATH LD_LIBRARY_PATH=$libraries
PKG_CONFIG_PATH=$(dirname "$pc")

cp -r "$source/examples/embed-linker" "$work/example"
check 'the example builds through pkg-config' make -C "$work/example"
run_example() {
    cd "$work/example" && ./embed-linker base.frag warm.frag stripes.frag >program.frag &&
        grep -q 'void main' program.frag && ! grep -q PLUG program.frag
}
check 'the example links two effects' run_example
check 'its program compiles' glslangValidator -S frag "$work/example/program.frag"
forty_lines() { [ "$(wc -l <"$source/examples/embed-linker/main.c")" -le 40 ]; }
check 'the example has at most forty lines' forty_lines

needed() { readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'; }
only_c() {
    needed "$library"
    ! needed "$library" | grep -qvE '^lib(c|m)\.so|^ld-linux'
}
check 'libplugray-plugs needs nothing but the C library' only_c
exports() { nm -D --defined-only "$1" | awk '{ print $3 }'; }
only_own() {
    exports "$1"
    [ "$(exports "$1" | grep -c '^plr_')" -gt 10 ] && ! exports "$1" | grep -vE '^plr_'
}
check 'libplugray-plugs exports plr_ names alone' only_own "$library"
check 'libplugray exports plr_ names alone' only_own "$whole"
declared() { # every function that the headers declare is in the library
    local missing=0 name
    for name in $(cat "$@" | sed -n 's/^PLR_API .*[ *]\(plr_[a-z0-9_]*\)(.*/\1/p'); do
        exports "$which" | grep -qx "$name" || { echo "missing: $name"; missing=1; }
    done
    return $missing
}
which=$library
check 'libplugray-plugs has all of base.h and plugs.h' \
    declared "$source"/include/plugray/{base,plugs}.h
which=$whole
check 'libplugray has all of the public headers' declared "$source"/include/plugray/*.h
no_gl() { ! nm -D --undefined-only "$whole" | awk '{ print $2 }' | grep -E '^(gl|egl|OSMesa)[A-Z]'; }
check 'libplugray refers to no function of GL by name' no_gl
engine_links() {
    printf '#include <plugray/engine.h>\nint main(void) { return plr_effects_file(0, 0, 0) == 0; }\n' \
        >"$work/engine.c" &&
        cc -o "$work/engine" "$work/engine.c" $(pkg-config --cflags --libs plugray) &&
        "$work/engine"
}
check 'a program links to plugray through pkg-config' engine_links
echo "1..$count"
exit $failed
