"""Fits the numbers of records to logs of joints, and judges models by logs."""
