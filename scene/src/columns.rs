//! The columns of a table: the header of each group and its values at a sample of the motion.

use twofold::dynamics::bulge::{bulge_potential, kinematic_momentum};
use twofold::dynamics::equations_of_motion::{angular_velocity, euler_rates_of_axis};
use twofold::dynamics::first_integrals::first_integrals;
use twofold::dynamics::{AxisState, RotationState};
use twofold::observables::pulsar::position_angle::{position_angle, position_angle_rate};
use twofold::observables::spin_axis::cos_lambda_rate;
use twofold::plan::{Output, State};

use crate::samples::Sample;
use crate::scene_file::{COLUMN_GROUPS, Scene, Units, did_you_mean, listed};
use crate::wave::spheroid_wave;

/// Names of the columns of a group with their units; empty for an output that is not a group of columns.
pub fn header(group: Output, units: &Units) -> Vec<String> {
    let time = units.time_name;
    let with_unit = |names: &[&str], unit: &str| names.iter().map(|name| format!("{name} [{unit}]")).collect();
    let components = |name: &str, unit: &str| ["X", "Y", "Z"].map(|axis| format!("{name}_{axis} [{unit}]")).to_vec();
    let value_and_rate =
        |name: &str, unit: &str| vec![format!("{name} [{unit}]"), format!("{name}_rate [{unit}/{time}]")];
    match group {
        Output::EulerAngles => with_unit(&["alpha", "beta", "gamma"], "rad"),
        Output::EulerRates => with_unit(&["alpha_rate", "beta_rate", "gamma_rate"], &format!("rad/{time}")),
        Output::EquatorialAxis => components("e_x", "1"),
        Output::SymmetryAxis => components("e_z", "1"),
        Output::AngularMomentum => components("L", units.momentum_name),
        Output::FirstIntegrals => vec![
            format!("E [{}]", units.energy_name),
            format!("Omega_z [rad/{time}]"),
            format!("K [({})^2]", units.momentum_name),
        ],
        Output::PerturbationAngles => with_unit(&["alpha_printed", "beta_printed"], "rad"),
        Output::SpinAxisAngle => value_and_rate("cos_lambda", "1"),
        Output::PulseProfile => value_and_rate("m.n", "1"),
        Output::MagneticAxis => with_unit(&["Theta", "Phi"], "rad"),
        Output::PositionAngle => value_and_rate("psi", "rad"),
        Output::GravitationalWave => with_unit(&["h_plus", "h_cross"], "1"),
        Output::Pulses => Vec::new(),
    }
}

/// The values of a group at a sample, one for each name in the [`header`], in the units of the output; `None` if they do not exist.
pub fn values(group: Output, scene: &Scene, sample: &Sample) -> Option<Vec<f64>> {
    let (body, s, units) = (scene.problem.spheroid(), scene.problem.coefficients(), &scene.units);
    let bulge = scene.problem.bulge();
    let moving = |state: &AxisState<f64>| kinematic_momentum(body, s, bulge, state);
    Some(match group {
        Output::EulerAngles => sample.angles.map(|a| vec![a.alpha, a.beta, a.gamma])?,
        Output::EulerRates => {
            let state = sample.axis();
            let rates = euler_rates_of_axis(body, &state.axis, &moving(&state)).ok()?;
            [rates.alpha, rates.beta, rates.gamma].map(|rate| rate / units.time).to_vec()
        }
        Output::EquatorialAxis => sample.orientation().equatorial_axis.as_slice().to_vec(),
        Output::SymmetryAxis => sample.axis().axis.as_slice().to_vec(),
        Output::AngularMomentum => (sample.axis().momentum * units.momentum).as_slice().to_vec(),
        Output::FirstIntegrals => {
            let state = sample.axis();
            let found = first_integrals(body, s, &state);
            let energy = found.energy + bulge_potential(bulge, s, &state.momentum);
            vec![energy * units.energy, found.spin / units.time, found.clebsch * units.momentum * units.momentum]
        }
        // Eq. (33) as printed: it starts at the initial values of the motion, unlike the corrected solution with the same
        // constants.
        Output::PerturbationAngles => {
            let angles = scene.perturbation.as_ref().ok()?.at(sample.since_start);
            vec![angles.alpha, angles.beta]
        }
        // Eq. (37): the angle between the symmetry axis and the direction to the observer.
        Output::SpinAxisAngle => {
            let direction = scene.observer?.basis().direction;
            let state = sample.axis();
            let rate = cos_lambda_rate(body, &direction, &state.axis, &moving(&state));
            vec![direction.dot(&state.axis), rate / units.time]
        }
        // Eq. (47).
        Output::PulseProfile => {
            let (beam, direction) = (scene.pulsar?.beam(), scene.observer?.basis().direction);
            let [_, rate, ..] = beam.margin_rates(body, s, bulge, sample.orientation(), &direction);
            vec![beam.direction(sample.orientation()).dot(&direction), rate / units.time]
        }
        // Eq. (49), from the components of `m`, which are regular where the Euler angles are not.
        Output::MagneticAxis => {
            let m = scene.pulsar?.beam().direction(sample.orientation());
            let across = m.x.hypot(m.y);
            (across > f64::EPSILON).then(|| vec![across.atan2(m.z), m.y.atan2(m.x)])?
        }
        // The rotating-vector model for the precessing star.
        Output::PositionAngle => {
            let state = sample.orientation();
            let (observer, m) = (scene.observer?.basis(), scene.pulsar?.beam().direction(state));
            let omega = angular_velocity(body, &state.axis, &moving(&state.axis_state()));
            let rate = position_angle_rate(&m, &omega, &observer);
            vec![position_angle(&m, &observer).ok()?, rate / units.time]
        }
        // Eq. (71): in the paper's units at r = 1, for a physical star the strain at its distance.
        Output::GravitationalWave => {
            let wave = spheroid_wave(body, s, &sample.axis(), &scene.observer?.basis(), scene.strain_unit());
            vec![wave.plus, wave.cross]
        }
        Output::Pulses => Vec::new(),
    })
}

/// Angles that grow without limit or jump by a turn: the spectrum of such an angle would be that of the growth or of the jumps.
const TURNING: [&str; 5] = ["alpha", "gamma", "alpha_printed", "Phi", "psi"];

/// The strain of a rotation perpendicular to the symmetry axis, `eps |L|^2` since `I^xx = 1`, plus the torque, `|s|` since `C = 1`. Each term of a
/// wave has this size, even where they cancel.
fn strain_of_rotation(scene: &Scene) -> f64 {
    let (body, s) = (scene.problem.spheroid(), scene.problem.coefficients());
    scene.strain_unit() * (body.oblateness().abs() * scene.problem.initial().momentum.norm_squared() + s.norm())
}

/// One column of a table.
#[derive(Debug)]
pub struct Column {
    /// The group to which it belongs, as an output of a plan; its angles need not include whole turns.
    pub group: Output,
    index: usize,
    /// The columns of its group with the same unit, including itself: the components of one quantity, with a common
    /// rounding.
    parts: Vec<usize>,
    /// Name as in the header of the table, without the unit.
    pub name: String,
    /// Unit.
    pub unit: String,
}

impl Column {
    /// The column called `name`, if it oscillates and the scene has the sections it needs.
    pub fn oscillating(name: &str, scene: &Scene) -> Result<Self, String> {
        if TURNING.contains(&name) {
            return Err(format!(
                "`{name}` grows without bound and has no line spectrum; use its rate, a component of an axis or m.n"
            ));
        }
        let columns = COLUMN_GROUPS.iter().flat_map(|(_, group)| Self::of_group(*group, scene));
        let (mut found, mut possible) = (None, Vec::new());
        for column in columns {
            let available = scene.has_what_is_needed_for(column.group);
            if column.name == name {
                found = Some(available.map(|()| column));
            } else if available.is_ok()
                && !TURNING.contains(&column.name.as_str())
                && column.group.need().state != State::Nothing
            {
                possible.push(column.name);
            }
        }
        let found = found.map(|found| found.and_then(Self::of_the_state));
        found.unwrap_or_else(|| {
            let possible: Vec<_> = possible.iter().map(String::as_str).collect();
            let guess = did_you_mean(name, &possible);
            Err(format!("`{name}` is not a column; expected one of {}.{guess}", listed(&possible)))
        })
    }

    fn of_the_state(self) -> Result<Self, String> {
        if self.group.need().state == State::Nothing {
            return Err(format!(
                "`{}` is a formula in time; lines can be found only for functions of the state",
                self.name
            ));
        }
        Ok(self)
    }

    fn of_group(group: Output, scene: &Scene) -> Vec<Self> {
        let titles = header(group, &scene.units);
        let of = |title: &str| {
            let (name, unit) = title.split_once(" [").unwrap_or((title, ""));
            (name.to_owned(), unit.trim_end_matches(']').to_owned())
        };
        let columns: Vec<_> = titles.iter().map(|title| of(title)).collect();
        let column = |(index, (name, unit)): (usize, &(String, String))| {
            let is_part = |&other: &usize| {
                let (name, its_unit) = &columns[other];
                other == index || its_unit == unit && !TURNING.contains(&name.as_str())
            };
            let parts = (0..columns.len()).filter(is_part).collect();
            Self { group, index, parts, name: name.clone(), unit: unit.clone() }
        };
        columns.iter().enumerate().map(column).collect()
    }

    /// The value at a sample and the size of the quantity that it is a component of, such as `|L|` for a component of `L`; `None`
    /// if they do not exist.
    pub fn value_and_size(&self, scene: &Scene, sample: &Sample) -> Option<(f64, f64)> {
        let values = values(self.group, scene, sample)?;
        let least = if self.group == Output::GravitationalWave { strain_of_rotation(scene) } else { 0.0 };
        let size = self.parts.iter().fold(least, |size, &part| size.hypot(values[part]));
        Some((values[self.index], size))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};
    use twofold::dynamics::{BodyState, Problem, RigidSpheroid};

    use super::*;
    use crate::samples::SampledState;

    /// The components of one quantity are its parts; angles that turn have no size, and integrals with three different units are three
    /// quantities.
    #[test]
    fn a_value_has_the_size_of_what_it_is_a_part_of() {
        let scene = Scene::named("tp-2").unwrap();
        let state = BodyState {
            axis: Vector3::new(0.6, 0.0, 0.8),
            momentum: Vector3::new(2.0, -3.0, 6.0),
            equatorial_axis: Vector3::y(),
        };
        let mut sample = Sample::new(0.0, SampledState::Orientation(state));
        sample.angles = Some(twofold::euler_angles::EulerAngles { alpha: 3.0, beta: -4.0, gamma: 12.0 });
        let of = |name| Column::oscillating(name, &scene).unwrap().value_and_size(&scene, &sample).unwrap();
        assert_eq!(of("L_Y"), (-3.0, 7.0));
        assert_eq!(of("beta"), (-4.0, 4.0));
        let (spin, size) = of("Omega_z");
        assert_eq!((spin, size), (spin, spin.abs()));
    }

    /// A star that spins by 3 about an axis perpendicular to its symmetry axis, seen along the spin axis, emits a wave of amplitude `2 eps 3^2` at
    /// twice the rotation rate: the moment of inertia is `1 + eps n n`, whose second derivative is up to `2 eps 3^2`, and `h` is minus twice that.
    /// Half of that is the size of the terms. A torque of the norm 5 is added to it, and the other polarization is added to the size.
    #[test]
    fn a_wave_has_the_size_of_its_terms_at_least() {
        for (ratio, torque, least) in
            [(1.25, 0.0, 0.25 * 9.0), (1.25, 1.0, 0.25 * 9.0 + 5.0), (0.75, 1.0, 0.25 * 9.0 + 5.0)]
        {
            let mut scene = Scene::named("wave-source").unwrap();
            let state = BodyState { axis: Vector3::x(), momentum: Vector3::z() * 3.0, equatorial_axis: Vector3::y() };
            let s = Matrix3::from_diagonal(&Vector3::new(0.0, 3.0, -4.0)) * torque;
            scene.problem = Problem::new(RigidSpheroid::in_units_of_tc(ratio), s, state).unwrap();
            scene.observer.as_mut().unwrap().theta_o = 0.0;
            let sample = Sample::new(0.0, SampledState::Orientation(state));
            let column = Column::oscillating("h_plus", &scene).unwrap();
            let (_, size) = column.value_and_size(&scene, &sample).unwrap();
            let wave = values(Output::GravitationalWave, &scene, &sample).unwrap();
            let expected = (least * scene.strain_unit()).hypot(wave[0]).hypot(wave[1]);
            assert!((size / expected - 1.0).abs() < 8.0 * f64::EPSILON, "{size:e} and {expected:e}");
        }
    }

    /// Columns that turn, and columns for which the scene has no section, are not offered.
    #[test]
    fn columns_are_offered_that_oscillate_and_can_be_computed() {
        let scene = Scene::named("wave-source").unwrap();
        let why = Column::oscillating("e_z_x", &scene).unwrap_err();
        let offered = why.split_once("expected one of ").unwrap().1;
        assert!(["`e_z_X`", "`beta`", "`h_plus`"].iter().all(|name| offered.contains(name)), "{why}");
        assert!(!["`alpha`", "`gamma`", "`psi`", "`m.n`"].iter().any(|name| offered.contains(name)), "{why}");
    }
}
