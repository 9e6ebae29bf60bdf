"""A reduced blade with as many fit speeds and modes as a tolerance asks for."""
