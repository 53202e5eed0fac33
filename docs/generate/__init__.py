"""What writes the pages that the site makes from the code: components, commands, gallery."""
