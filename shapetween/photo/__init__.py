"""Pictures between pictures: quads of one photograph become quads of another, projectively.

.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007, section 6 and Figure 6.
"""
