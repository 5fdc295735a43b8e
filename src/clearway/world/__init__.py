"""Where robots may be."""
