"""The law that the paper's Table 4 states for the core of its plate."""

from fitting.laws.fractional_zener import FractionalZener

TABLE_4 = FractionalZener(g0_pa=0.27e6, ginf_pa=4.1e6, tau_s=1.21e-4, alpha=0.83)
