"""What the implicit methods share: control numbers, sizes of steps, and what a failure leaves."""
