"""Output that several commands share: lines for people, values for programs."""
