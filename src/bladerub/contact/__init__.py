"""Stage 2: one rub of the reduced blade on one coating at one speed (`RunSpec` → `RunResult`)."""
