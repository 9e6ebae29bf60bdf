"""Laws of the coating beside that of the paper, each the text of a module (`bladerub.contact.laws`)."""
