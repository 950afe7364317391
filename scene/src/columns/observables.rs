//! Columns of what an observer measures.

use twofold::dynamics::equations_of_motion::angular_velocity;
use twofold::observables::gravitational_wave::{strain_unit, wave_of_state};
use twofold::observables::pulsar::position_angle::{position_angle, position_angle_rate};
use twofold::observables::spin_axis::cos_lambda_rate;
use twofold::plan::Output;
use twofold::propagation::AxisState;

use super::{ColumnGroup, Need, with_unit};
use crate::scene_file::{Scene, Units};

/// Eq. (37): the angle between the symmetry axis and the direction to the observer.
pub(super) const LAMBDA: ColumnGroup = ColumnGroup {
    name: "lambda",
    needs: &[Need::Observer],
    output: Output::SpinAxisAngle,
    header: |units| value_and_rate("cos_lambda", units),
    values: |scene, moment| {
        let direction = scene.observer?.basis().direction;
        let AxisState { axis, momentum } = moment.axis();
        let rate = cos_lambda_rate(&scene.spheroid, &direction, &axis, &momentum);
        Some(vec![direction.dot(&axis), rate / scene.units.time])
    },
};

/// Eq. (47).
pub(super) const LINE_OF_SIGHT: ColumnGroup = ColumnGroup {
    name: "m.n",
    needs: &[Need::Observer, Need::Pulsar],
    output: Output::PulseProfile,
    header: |units| value_and_rate("m.n", units),
    values: |scene, moment| {
        let (beam, direction) = (scene.pulsar?.beam(), scene.observer?.basis().direction);
        let [_, rate, ..] = beam.margin_rates(&scene.spheroid, &scene.violation, moment.orientation(), &direction);
        Some(vec![beam.direction(moment.orientation()).dot(&direction), rate / scene.units.time])
    },
};

/// Eq. (49), by the components of `m`, which are regular where the Euler angles are not.
pub(super) const MAGNETIC_AXIS: ColumnGroup = ColumnGroup {
    name: "magnetic_axis",
    needs: &[Need::Pulsar],
    output: Output::MagneticAxis,
    header: |_| with_unit(&["Theta", "Phi"], "rad"),
    values: |scene, moment| {
        let m = scene.pulsar?.beam().direction(moment.orientation());
        let across = m.x.hypot(m.y);
        (across > f64::EPSILON).then(|| vec![across.atan2(m.z), m.y.atan2(m.x)])
    },
};

/// The rotating-vector model for the precessing star.
pub(super) const POSITION_ANGLE: ColumnGroup = ColumnGroup {
    name: "position_angle",
    needs: &[Need::Observer, Need::Pulsar],
    output: Output::PositionAngle,
    header: |units| vec!["psi [rad]".to_owned(), format!("psi_rate [rad/{}]", units.time_name)],
    values: |scene, moment| {
        let state = moment.orientation();
        let (observer, m) = (scene.observer?.basis(), scene.pulsar?.beam().direction(moment.orientation()));
        let omega = angular_velocity(&scene.spheroid, &state.axis, &state.momentum);
        let rate = position_angle_rate(&m, &omega, &observer);
        Some(vec![position_angle(&m, &observer).ok()?, rate / scene.units.time])
    },
};

/// Eq. (71): in the paper's units at r = 1, for a physical star the strain at its distance.
pub(super) const STRAIN: ColumnGroup = ColumnGroup {
    name: "h",
    needs: &[Need::Observer, Need::Distance],
    output: Output::GravitationalWave,
    header: |_| with_unit(&["h_plus", "h_cross"], "1"),
    values: |scene, moment| {
        let observer = scene.observer?;
        let h = wave_of_state(&scene.spheroid, &scene.violation, &moment.axis(), &observer.basis());
        let unit = observer.distance.map_or(1.0, |distance| strain_of_scene(scene, distance));
        Some(vec![h.plus * unit, h.cross * unit])
    },
};

/// The strain of `h = 1` at a distance in m.
pub fn strain_of_scene(scene: &Scene, distance: f64) -> f64 {
    strain_unit(scene.units.inertia_in_si(), scene.units.time, distance)
}

fn value_and_rate(name: &str, units: &Units) -> Vec<String> {
    vec![format!("{name} [1]"), format!("{name}_rate [1/{}]", units.time_name)]
}
