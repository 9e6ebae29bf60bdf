"""The models of a config, by section; `bladerub.settings.fields` says how they are written."""
