"""Stage 2: one rub of the reduced blade on one coating at one speed (`RunSpec` → `RunResult`)."""

from bladerub.contact.run import kernel_warm_up, simulate

__all__ = ["kernel_warm_up", "simulate"]
