//! The axis about which the angular momentum precesses.

use nalgebra::Matrix3;

use super::angles::slow_angles;
use super::samples::Averaged;
use super::turns::turns;
use crate::euler_angles::permuted_from_inertial;

/// The frame of the first principal axis where the averaged `L` goes round that by more than half a turn and farther than round the third
/// one; else that of the third one.
pub(super) fn frame_of_precession(principal: &Matrix3<f64>, averages: &[Averaged]) -> Matrix3<f64> {
    let about_third = axis_to_front(principal);
    let about_first = axis_to_front(&(permuted_from_inertial::<f64>() * principal));
    let [first, third] = [about_first, about_third].map(|frame| turns(&slow_angles(averages, &frame)));
    if first > third.max(0.5) { about_first } else { about_third }
}

/// The frame with its third axis turned, if need be, to the positive side of the axis of the motion's frame nearest to it.
fn axis_to_front(frame: &Matrix3<f64>) -> Matrix3<f64> {
    let axis = frame.row(2).transpose();
    if axis[axis.iamax()] >= 0.0 {
        return *frame;
    }
    Matrix3::from_rows(&[-frame.row(0), frame.row(1).into_owned(), -frame.row(2)])
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use nalgebra::Vector3;

    use super::*;
    use crate::dynamics::BodyState;

    #[test]
    fn the_frame_is_that_of_the_axis_gone_round_farther() {
        // Over a path of the length one.
        let axis = |momentum: &dyn Fn(f64) -> Vector3<f64>| {
            let still = BodyState { axis: Vector3::z(), momentum: Vector3::z(), equatorial_axis: Vector3::x() };
            let averages: Vec<_> = (0..=100)
                .map(|i| Averaged { state: still, fast_axis: Vector3::x(), momentum: momentum(f64::from(i) / 100.0) })
                .collect();
            frame_of_precession(&Matrix3::identity(), &averages).row(2).transpose()
        };
        let phase = |turns: f64, part: f64| (TAU * turns * part + 2.0).sin_cos();
        for sign in [1.0, -1.0] {
            for (turns, found) in [(0.45, Vector3::z()), (0.55, Vector3::x()), (1.4, Vector3::x()), (3.0, Vector3::x())]
            {
                let around_x = |part| {
                    let (sin, cos) = phase(sign * turns, part);
                    Vector3::new(0.9, 0.3 * cos, 0.3 * sin)
                };
                assert_eq!(axis(&around_x), found, "{turns}");
                let around_z = |part| {
                    let (sin, cos) = phase(sign * turns, part);
                    Vector3::new(0.3 * cos, 0.3 * sin, 0.9)
                };
                assert_eq!(axis(&around_z), Vector3::z(), "{turns}");
            }
            // Three turns round one of both axes, two round the other.
            let three = |part: f64| (TAU * 3.0 * sign * part).sin_cos();
            let two = |part: f64| if part < 2.0 / 3.0 { three(part).1 } else { 1.0 };
            assert_eq!(axis(&|part| Vector3::new(three(part).1, three(part).0, two(part))), Vector3::z());
            assert_eq!(axis(&|part| Vector3::new(two(part), three(part).0, three(part).1)), Vector3::x());
        }
    }

    /// In the principal frame of a tensor along no axis.
    #[test]
    fn frames_are_turned_to_the_positive_side_and_stay_rotations() {
        use nalgebra::Rotation3;

        let principal = Rotation3::from_euler_angles(0.4, -0.7, 1.1).into_inner();
        let nearest = |frame: &Matrix3<f64>| frame.row(2)[frame.row(2).transpose().iamax()];
        let other = Matrix3::from_rows(&[-principal.row(0), principal.row(1).into_owned(), -principal.row(2)]);
        let (front, back) = if nearest(&principal) > 0.0 { (principal, other) } else { (other, principal) };
        assert!(nearest(&front) < 0.99);
        assert_eq!((axis_to_front(&front), axis_to_front(&back)), (front, front));
        // L goes round the first principal axis, and farther than round the third one.
        let still = BodyState { axis: Vector3::z(), momentum: Vector3::z(), equatorial_axis: Vector3::x() };
        let averages: Vec<_> = (0..=100)
            .map(|i| {
                let (sin, cos) = (0.06 * f64::from(i)).sin_cos();
                let momentum = principal.transpose() * Vector3::new(0.9, 0.3 * cos, 0.3 * sin);
                Averaged { state: still, fast_axis: Vector3::x(), momentum }
            })
            .collect();
        let found = frame_of_precession(&principal, &averages);
        assert!((found.determinant() - 1.0).abs() < 1e-14);
        assert!((found.row(2).transpose().dot(&principal.row(0).transpose()).abs() - 1.0).abs() < 1e-14, "{found}");
    }
}
