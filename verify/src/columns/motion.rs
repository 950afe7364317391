//! Columns of the motion itself and of its perturbation solutions.

use twofold::dynamics::first_integrals::first_integrals;

use super::{ColumnGroup, Need, components, with_unit};

pub(super) const ANGLES: ColumnGroup = ColumnGroup {
    name: "angles",
    needs: &[],
    counts_turns: true,
    header: |_| with_unit(&["alpha", "beta", "gamma"], "rad"),
    values: |_, moment| (moment.angles)().map(|a| vec![a.alpha, a.beta, a.gamma]),
};

pub(super) const RATES: ColumnGroup = ColumnGroup {
    name: "rates",
    needs: &[],
    counts_turns: false,
    header: |units| with_unit(&["alpha_rate", "beta_rate", "gamma_rate"], &format!("rad/{}", units.time_name)),
    values: |scene, moment| {
        let rates = moment.state.rates(&scene.spheroid).ok()?;
        Some([rates.alpha, rates.beta, rates.gamma].map(|rate| rate / scene.units.time).to_vec())
    },
};

pub(super) const EQUATORIAL_AXIS: ColumnGroup = ColumnGroup {
    name: "e_x",
    needs: &[],
    counts_turns: false,
    header: |_| components("e_x", "1"),
    values: |_, moment| Some(moment.state.equatorial_axis.as_slice().to_vec()),
};

pub(super) const SYMMETRY_AXIS: ColumnGroup = ColumnGroup {
    name: "e_z",
    needs: &[],
    counts_turns: false,
    header: |_| components("e_z", "1"),
    values: |_, moment| Some(moment.state.axis.as_slice().to_vec()),
};

pub(super) const MOMENTUM: ColumnGroup = ColumnGroup {
    name: "L",
    needs: &[],
    counts_turns: false,
    header: |units| components("L", units.momentum_name),
    values: |scene, moment| Some((moment.state.momentum * scene.units.momentum).as_slice().to_vec()),
};

pub(super) const INTEGRALS: ColumnGroup = ColumnGroup {
    name: "integrals",
    needs: &[],
    counts_turns: false,
    header: |units| {
        vec![
            format!("E [{}]", units.energy_name),
            format!("Omega_z [rad/{}]", units.time_name),
            format!("K [({})^2]", units.momentum_name),
        ]
    },
    values: |scene, moment| {
        let integrals = first_integrals(&scene.spheroid, &scene.violation, &moment.state);
        let units = &scene.units;
        Some(vec![
            integrals.energy * units.energy,
            integrals.spin / units.time,
            integrals.clebsch * units.momentum * units.momentum,
        ])
    },
};

/// Eq. (33) as printed: it starts with the motion, which the corrected solution of the same constants does not.
pub(super) const PERTURBATION: ColumnGroup = ColumnGroup {
    name: "perturbation",
    needs: &[Need::Constants],
    counts_turns: false,
    header: |_| with_unit(&["alpha_printed", "beta_printed"], "rad"),
    values: |scene, moment| {
        let angles = scene.perturbation.as_ref().ok()?.at(moment.since_start);
        Some(vec![angles.alpha, angles.beta])
    },
};
