"""The study repeated with other inputs: how far its answers depend on what the paper leaves open.

`plan` reads what varies and which jobs it takes, and turns positions in ranges into numbers of the config;
`waves` draws positions, and `job` simulates sets of inputs: one plan, one sampler, one kind of job.

Summaries: `verdicts` compares those of several sets, and judges the claims again on parts of a study;
`robustness` gives the share in which a claim holds and what decides it; `identification` says which values
agree with the paper, by `targets` and `emulator`.
"""
