import importlib.metadata

project = "nmm"
copyright = "the nmm authors"
release = importlib.metadata.version("nmm-framework")
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
suppress_warnings = ["myst.xref_missing"]  # links that serve readers of the source
exclude_patterns = ["_build", "manifold_cost/*.md"]  # tables without a title
html_theme = "furo"
html_title = f"nmm {release}"
