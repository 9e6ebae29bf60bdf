"""The installed command ``bladerub``, which Ctrl-C ends without a traceback even while it is imported."""

import sys


def main() -> int:
    """Run the command line; return as `bladerub.cli.main`."""
    try:
        from bladerub import cli

        return cli.main()
    except KeyboardInterrupt:
        print("bladerub: interrupted", file=sys.stderr)
        return 130
