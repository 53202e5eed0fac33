"""What a run tells beyond its signals: energy closure, creep of stuck contacts, broken limits."""
