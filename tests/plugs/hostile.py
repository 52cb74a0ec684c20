#!/usr/bin/env python3
"""The linker as a black box, fed by a hostile author: hostile.py PLUGRAY [CASE...]"""

import blackbox
import hostile_faults  # noqa: F401
import hostile_legacy  # noqa: F401
import hostile_names  # noqa: F401
import hostile_text  # noqa: F401

blackbox.run(blackbox.CASES)
