#!/bin/sh
# Each public header compiles alone, as C11 and as C++17: headers.sh INCLUDE-FOLDER
set -u
count=0 failed=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for header in "$1"/plugray/*.h; do
    for language in c:c11:gcc c++:c++17:g++; do
        name=${language%%:*} rest=${language#*:}
        standard=${rest%%:*} compiler=${rest#*:}
        count=$((count + 1))
        printf '#include <plugray/%s>\n' "$(basename "$header")" >"$work/alone"
        if "$compiler" -x "$name" -std="$standard" -Wall -Wextra -Wpedantic -Werror -fsyntax-only \
            -I"$1" "$work/alone" 2>"$work/log"; then
            echo "ok $count - $(basename "$header") compiles alone as $standard"
        else
            failed=1
            echo "not ok $count - $(basename "$header") compiles alone as $standard"
            sed 's/^/#   /' "$work/log"
        fi
    done
done
echo "1..$count"
exit $failed
