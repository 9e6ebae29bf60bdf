"""Stage 2: one rub of the reduced blade on one coating at one speed (`RunSpec` → `RunResult`).

`bladerub.contact.run.simulate` is the way in. It is not imported here, so that who only describes runs
(`bladerub.contact.spec`) does not wait for the compiler.
"""
