#!/usr/bin/env python3
"""TAP: the library refers to no gl*, egl* or OSMesa* symbol, so that no GL library is linked.

usage: symbols.py LIBRARY"""
import re
import subprocess
import sys

output = subprocess.run(['nm', '-u', sys.argv[1]], capture_output=True, text=True, check=True).stdout
undefined = {line.split()[-1] for line in output.splitlines() if line.strip().startswith('U ')}
direct = sorted(name for name in undefined if re.match(r'(gl|egl|OSMesa)[A-Z]', name))
print('ok 1 - nm lists what the library needs' if 'malloc' in undefined else 'not ok 1 - nm is silent')
print(('not ok' if direct else 'ok') + ' 2 - no direct call of GL ' + ' '.join(direct))
print('1..2')
