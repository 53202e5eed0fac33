"""Tests of fairlead."""
