//! Columns of the motion itself and of its perturbation solutions.

use twofold::dynamics::equations_of_motion::euler_rates_of_axis;
use twofold::dynamics::first_integrals::first_integrals;
use twofold::plan::Output;
use twofold::propagation::AxisState;

use super::{ColumnGroup, Need, components, with_unit};

pub(super) const ANGLES: ColumnGroup = ColumnGroup {
    name: "angles",
    needs: &[],
    output: Output::EulerAngles,
    header: |_| with_unit(&["alpha", "beta", "gamma"], "rad"),
    values: |_, moment| (moment.angles)().map(|a| vec![a.alpha, a.beta, a.gamma]),
};

pub(super) const RATES: ColumnGroup = ColumnGroup {
    name: "rates",
    needs: &[],
    output: Output::EulerRates,
    header: |units| with_unit(&["alpha_rate", "beta_rate", "gamma_rate"], &format!("rad/{}", units.time_name)),
    values: |scene, moment| {
        let AxisState { axis, momentum } = moment.axis();
        let rates = euler_rates_of_axis(&scene.spheroid, &axis, &momentum).ok()?;
        Some([rates.alpha, rates.beta, rates.gamma].map(|rate| rate / scene.units.time).to_vec())
    },
};

pub(super) const EQUATORIAL_AXIS: ColumnGroup = ColumnGroup {
    name: "e_x",
    needs: &[],
    output: Output::EquatorialAxis,
    header: |_| components("e_x", "1"),
    values: |_, moment| Some(moment.orientation().equatorial_axis.as_slice().to_vec()),
};

pub(super) const SYMMETRY_AXIS: ColumnGroup = ColumnGroup {
    name: "e_z",
    needs: &[],
    output: Output::SymmetryAxis,
    header: |_| components("e_z", "1"),
    values: |_, moment| Some(moment.axis().axis.as_slice().to_vec()),
};

pub(super) const MOMENTUM: ColumnGroup = ColumnGroup {
    name: "L",
    needs: &[],
    output: Output::AngularMomentum,
    header: |units| components("L", units.momentum_name),
    values: |scene, moment| Some((moment.axis().momentum * scene.units.momentum).as_slice().to_vec()),
};

pub(super) const INTEGRALS: ColumnGroup = ColumnGroup {
    name: "integrals",
    needs: &[],
    output: Output::FirstIntegrals,
    header: |units| {
        vec![
            format!("E [{}]", units.energy_name),
            format!("Omega_z [rad/{}]", units.time_name),
            format!("K [({})^2]", units.momentum_name),
        ]
    },
    values: |scene, moment| {
        let (found, units) = (first_integrals(&scene.spheroid, &scene.violation, &moment.axis()), &scene.units);
        Some(vec![
            found.energy * units.energy,
            found.spin / units.time,
            found.clebsch * units.momentum * units.momentum,
        ])
    },
};

/// Eq. (33) as printed: it starts with the motion, which the corrected solution of the same constants does not.
pub(super) const PERTURBATION: ColumnGroup = ColumnGroup {
    name: "perturbation",
    needs: &[Need::Constants],
    output: Output::PerturbationAngles,
    header: |_| with_unit(&["alpha_printed", "beta_printed"], "rad"),
    values: |scene, moment| {
        let angles = scene.perturbation.as_ref().ok()?.at(moment.since_start);
        Some(vec![angles.alpha, angles.beta])
    },
};
