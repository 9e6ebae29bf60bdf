"""Stage 2: contact of the reduced blade with one coating at one speed (`RunSpec` → `RunResult`).

Call `bladerub.contact.run.simulate`. It is not imported here, so that a program that only describes runs
(`bladerub.contact.spec`) does not load the compiler. `bladerub.contact.reference` has the model on a page.
"""
