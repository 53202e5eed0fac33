"""Damaged input, made at random from a seed: whatever it is, fairlead answers it in words, soon and with a known code.

    python -m tests.fuzz netlists --count 5000 --seed 7
"""
