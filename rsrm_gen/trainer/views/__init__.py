"""Where the points of a manifold are drawn: in a plane, and as a surface in space. Nothing here knows a manifold's name."""
