"""ABAM and RKF45: an explicit Runge-Kutta pair of order 8(5,3)."""
