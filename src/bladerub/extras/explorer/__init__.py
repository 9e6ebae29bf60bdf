"""The explorer: one page that holds the whole study, opened from a file; ``page/`` runs in the browser."""
