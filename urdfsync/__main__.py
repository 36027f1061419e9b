"""`python -m urdfsync` is `urdfsync`."""

import sys

from urdfsync.cli import main

sys.exit(main())
