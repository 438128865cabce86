"""Builds the project's own scenes; run scenes/make_scenes.py."""
