//! The reference motions: initial values and 34-digit states of ten scenes, and the pulses of two, as test data.

use crate::prelude::*;

/// One reference motion.
#[derive(Clone)]
pub struct ReferenceMotion {
    /// Name of the scene.
    pub name: String,
    /// The body, in units `I^xx = C = 1`.
    pub spheroid: RigidSpheroid<f64>,
    /// Eigenvalues of `s^IJ`.
    pub coefficients: PrincipalCoefficients<f64>,
    /// Spin `Omega^z`.
    pub spin: f64,
    /// Euler angles at `t = 0`.
    pub angles: EulerAngles<f64>,
    /// Euler rates at `t = 0`.
    pub rates: EulerRates<f64>,
    /// Times and states, the first at `t = 0`.
    pub states: Vec<(f64, BodyState<f64>)>,
}

/// Implements `Debug` for a type as its name.
macro_rules! named {
    ($type:ty) => {
        impl std::fmt::Debug for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(&self.name)
            }
        }
    };
}
pub(crate) use named;

named!(ReferenceMotion);
named!(ReferenceGradient);

impl ReferenceMotion {
    /// `s^IJ` in its principal frame.
    pub fn violation(&self) -> Matrix3<f64> {
        self.coefficients.tensor()
    }

    /// The problem that starts with the Euler angles and rates at `t = 0`.
    ///
    /// # Panics
    /// If the data compiled into the program are malformed.
    pub fn problem(&self) -> Problem<f64> {
        let problem = Problem::from_angles(self.spheroid, self.violation(), &self.angles, &self.rates);
        problem.expect("the reference motions start from physical states")
    }

    /// State at `t = 0` from the Euler angles and rates.
    pub fn initial(&self) -> BodyState<f64> {
        BodyState::from_angles(&self.spheroid, &self.angles, &self.rates)
    }
}

/// All ten reference motions.
///
/// # Panics
/// If the data compiled into the program are malformed.
pub fn reference_motions() -> Vec<ReferenceMotion> {
    let scenes = rows(include_str!("../data/reference_scenes.csv"));
    let states = rows(include_str!("../data/reference_states.csv"));
    scenes
        .into_iter()
        .map(|(name, v)| {
            let angles = EulerAngles { alpha: v[5], beta: v[6], gamma: v[7] };
            ReferenceMotion {
                spheroid: RigidSpheroid::in_units_of_tc(v[0]),
                spin: v[1],
                coefficients: PrincipalCoefficients::new([v[2], v[3], v[4]]),
                angles,
                rates: EulerRates { alpha: v[8], beta: v[9], gamma: v[1] - v[8] * angles.beta.cos() },
                states: states
                    .iter()
                    .filter(|(scene, _)| *scene == name)
                    .map(|(_, v)| {
                        let vector = |i: usize| Vector3::new(v[i], v[i + 1], v[i + 2]);
                        let state = BodyState { axis: vector(1), momentum: vector(4), equatorial_axis: vector(7) };
                        (v[0], state)
                    })
                    .collect(),
                name,
            }
        })
        .collect()
}

/// The reference motion called `name`.
///
/// # Panics
/// If there is none.
pub fn reference_motion(name: &str) -> ReferenceMotion {
    reference_motions()
        .into_iter()
        .find(|motion| motion.name == name)
        .unwrap_or_else(|| panic!("no reference motion is called {name}"))
}

/// One complete reference pulse of the beam `chi = 0.5`, `delta = 0`, `rho = 0.6`, seen from `theta_o = 0.8`, `phi_o = 0`.
#[derive(Debug, Clone, Copy)]
pub struct ReferencePulse {
    /// Time at which the line of sight enters the beam.
    pub start: f64,
    /// Time of leaving the beam.
    pub end: f64,
    /// Time at which `m.n` is largest.
    pub closest_approach: f64,
}

/// The first reference pulses of `tp-1` or `tp-2`, in order of time.
///
/// # Panics
/// If the data compiled into the program are malformed.
pub fn reference_pulses(scene: &str) -> Vec<ReferencePulse> {
    rows(include_str!("../data/pulse_edges.csv"))
        .into_iter()
        .filter(|(name, _)| name == scene)
        .map(|(_, v)| ReferencePulse { start: v[0], end: v[1], closest_approach: v[2] })
        .collect()
}

/// Derivatives of a motion with respect to the parameters of its scene.
#[derive(Clone)]
pub struct ReferenceGradient {
    /// Name of the scene.
    pub name: String,
    /// The scene.
    pub start: Parameters<f64>,
    /// Times, and at each time, for every parameter in the order of [`Parameter::OF_MOTION`], the derivatives of the components of `n`, `L` and
    /// `e_x`.
    pub derivatives: Vec<(f64, Vec<[f64; 9]>)>,
}

/// All reference derivatives.
///
/// # Panics
/// If the data compiled into the program are malformed.
pub fn reference_gradients() -> Vec<ReferenceGradient> {
    let rows = rows(include_str!("../data/reference_gradients.csv"));
    let of_scene = |scene: &[(String, Vec<f64>)]| {
        let (angles, rates) =
            (EulerAngles { alpha: 0.0, beta: 0.0, gamma: 0.0 }, EulerRates { alpha: 0.0, beta: 0.0, gamma: 0.0 });
        let spheroid = RigidSpheroid { inertia_xx: 0.0, inertia_zz: 0.0, constant_c: 0.0 };
        let mut start = Parameters::new(spheroid, Matrix3::zeros(), angles, rates);
        let mut derivatives: Vec<(f64, Vec<[f64; 9]>)> = Vec::new();
        for (_, row) in scene {
            let (index, value, t) = (row[0] as usize, row[1], row[2]);
            if !derivatives.iter().any(|(time, _)| *time == t) {
                derivatives.push((t, Vec::new()));
            }
            let at = derivatives.iter().position(|(time, _)| *time == t).expect("one was pushed");
            assert_eq!(derivatives[at].1.len(), index, "parameters in order");
            derivatives[at].1.push(core::array::from_fn(|i| row[3 + i]));
            if at == 0 {
                Parameter::OF_MOTION[index].add(&mut start, value);
            }
        }
        ReferenceGradient { name: scene[0].0.clone(), start, derivatives }
    };
    rows.chunk_by(|(first, _), (second, _)| first == second).map(of_scene).collect()
}

fn rows(text: &'static str) -> Vec<(String, Vec<f64>)> {
    let numbers = |record: &csv::StringRecord| record.iter().skip(1).map(|x| x.parse().expect("a number")).collect();
    records(text).map(|record| (record[0].to_string(), numbers(&record))).collect()
}

/// The rows of a table compiled into the program.
pub(crate) fn records(text: &'static str) -> impl Iterator<Item = csv::StringRecord> {
    let reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    reader.into_records().map(|record| record.expect("a table compiled into the program is well-formed CSV"))
}
