"""The models of a config, by section; `bladerub.config.fields` says how they are written."""
