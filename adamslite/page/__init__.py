"""The page: one HTML file with a scene, its results, and the program that draws them."""
