"""Adapters of the engines that come with the benchmark."""
