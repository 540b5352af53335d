"""The hooks of effects by their purpose: forces, energies, exchange, reports, state in time."""
