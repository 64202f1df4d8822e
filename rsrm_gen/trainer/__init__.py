"""Arrival-time fields on any manifold behind the `Manifold` protocol: scenes, model, training, planning."""
