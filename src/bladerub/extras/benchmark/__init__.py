"""How fast the time loop is: beside plain loops, and beside the arithmetic of the processor."""
