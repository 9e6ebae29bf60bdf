"""The explorer: one page that holds the whole study, to be opened from a file, without server or network.

It comes after ``plots``, whose colours, cells and titles it shares; what is in ``page/`` runs in the browser.
"""
