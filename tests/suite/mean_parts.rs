//! The parts of the averaged motion against their definitions: theta functions by their series, the top by its equations of motion.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3, Vector3};
use num_dual::{Dual64, DualNum};
use twofold::numerics::elliptic::jacobi::{complete_integral, jacobi};
use twofold::numerics::elliptic::theta::{Nome, ThetaSeries};
use twofold::solutions::averaged::Top;

/// `theta_1(z + i eta)` (real and imaginary part), `theta_4(z)` and its slope, term by term.
fn theta(q: f64, z: f64, eta: f64) -> ([f64; 2], [f64; 2]) {
    let (mut first, mut fourth) = ([0.0; 2], [1.0, 0.0]);
    for n in 0..40 {
        let order = f64::from(n);
        let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
        let (half, odd) = (order + 0.5, 2.0 * order + 1.0);
        // q^((n + 1/2)^2) beside the hyperbolic functions, which are large.
        let [up, down] = [1.0, -1.0].map(|side: f64| (half * half * q.ln() + side * odd * eta).exp() / 2.0);
        first[0] += 2.0 * sign * (odd * z).sin() * (up + down);
        first[1] += 2.0 * sign * (odd * z).cos() * (up - down);
        if n > 0 {
            let power = 2.0 * sign * (order * order * q.ln()).exp();
            fourth[0] += power * (2.0 * order * z).cos();
            fourth[1] -= power * 2.0 * order * (2.0 * order * z).sin();
        }
    }
    (first, fourth)
}

#[test]
fn theta_functions_are_their_series() {
    for m1 in [1.0 - 1e-6, 0.7, 0.4, 0.1, 0.03, 0.012, 0.003, 1e-4, 1e-6] {
        let m = 1.0 - m1;
        let nome = Nome::new(m, m1);
        let ratio = complete_integral(m) / complete_integral(m1);
        // complete_integral takes the complement.
        let decay = std::f64::consts::PI * ratio;
        assert_relative_eq!(nome.q, (-decay).exp(), max_relative = 1e-13);
        assert_relative_eq!(nome.q_over_m, nome.q / m, max_relative = 1e-13);
        assert_eq!(nome.decay.is_some(), nome.q >= 0.3);
        if let Some(found) = nome.decay {
            assert_relative_eq!(found, decay, max_relative = 1e-14);
        }
        for share in [0.03, 0.3, 0.5, 0.8, 0.97] {
            // r = q^share, exp(-2 eta).
            let eta = 0.5 * decay * share;
            let by_nome = ThetaSeries::new(nome.q, (-2.0 * eta).exp(), (-decay * (1.0 - share)).exp());
            let turned = std::f64::consts::PI * eta / decay;
            let transformed = (nome.q > 1e-3).then(|| ThetaSeries::transformed(decay, turned));
            for series in [Some(by_nome), transformed].into_iter().flatten() {
                for z in [0.0, 0.02, 0.4, -0.9, 1.5, 1.63, 2.8, -3.0, 7.1] {
                    let at = series.at(f64::sin(z), f64::cos(z));
                    let u = 2.0 / std::f64::consts::PI * complete_integral(m1) * z;
                    let exact = jacobi(u, m1);
                    for (found, exact) in [(at.sn, exact.sn), (at.cn, exact.cn), (at.dn, exact.dn)] {
                        assert!((found - exact).abs() < 1e-14 * (1.0 + u.abs()), "{m1} {share} {z}: {found} {exact}");
                    }
                    // The sums of theta_4 and theta_1 cancel as q goes to one.
                    let size = if nome.q < 0.5 { 1e-13 } else { 1e-8 };
                    let (first, fourth) = theta(nome.q, z, eta);
                    let slope = fourth[1] / fourth[0];
                    assert!(
                        (at.slope - slope).abs() < size * (1.0 + slope.abs()),
                        "{m1} {share} {z}: {} {slope}",
                        at.slope
                    );
                    // i theta_1
                    let wanted = [-first[1], first[0]];
                    let lengths = at.shifted[0].hypot(at.shifted[1]) * wanted[0].hypot(wanted[1]);
                    let across = (at.shifted[0] * wanted[1] - at.shifted[1] * wanted[0]) / lengths;
                    let along = (at.shifted[0] * wanted[0] + at.shifted[1] * wanted[1]) / lengths;
                    assert!(across.abs() < size && along > 0.0, "{m1} {share} {z}: {across:e} {along}");
                }
            }
        }
    }
}

/// `l`, the frame that it carries along, and what is integrated, at a time.
fn at(top: &Top<f64>, t: f64) -> (Matrix3<f64>, Vector3<f64>) {
    let rates = top.rates;
    let shape = top.at(top.start + rates.slow * t);
    let about = rates.about * t + shape.turned[1].atan2(shape.turned[0]);
    (shape.frame * Rotation3::from_axis_angle(&Vector3::z_axis(), about), top.squares(shape.integral))
}

#[test]
fn a_top_turns_with_its_angular_velocity() {
    let mut seen = 0;
    for k in
        [[0.9, 0.2, -0.4], [0.2, -0.4, 0.9], [-0.4, 0.9, 0.2], [0.2, 0.9, -0.4], [0.9, -0.4, 0.2], [-0.4, 0.2, 0.9]]
    {
        let middle = k.iter().position(|x| *x == 0.2).expect("it is there");
        for direction in [
            [0.3, 0.5, 0.8],
            [-0.7, 0.2, 0.4],
            [0.6, -0.6, -0.5],
            [0.5, 0.5, -1.2],
            [-0.8, -0.5, 0.1],
            [0.1, -0.9, 0.2],
            [1e-3, 2e-3, 1.0],
            [-1.0, 1e-3, 2e-3],
        ] {
            let l = Vector3::from(direction).normalize();
            let top = Top::new(k, &l);
            assert!(top.goes_round() && top.complement() > 0.0);
            let (start, _) = at(&top, 0.0);
            assert_relative_eq!(start.column(2).into_owned(), l, epsilon = 1e-14);
            // The axis is that of the largest or the smallest value, which l stays on one side of.
            let energy = |l: &Vector3<f64>| (0..3).map(|i| k[i] * l[i] * l[i]).sum::<f64>();
            let period = std::f64::consts::TAU / top.rates.slow.abs();
            let h = 1e-4;
            for j in 0..24 {
                let t = period * (f64::from(j) / 24.0 - 0.4);
                let [(before, squares_before), (frame, _), (after, squares_after)] =
                    [-h, 0.0, h].map(|h| at(&top, t + h));
                let l = frame.column(2).into_owned();
                assert_relative_eq!(l.norm(), 1.0, epsilon = 1e-14);
                assert_relative_eq!(frame.determinant(), 1.0, epsilon = 1e-14);
                assert_relative_eq!(energy(&l), energy(&start.column(2).into_owned()), epsilon = 1e-14);
                let omega = Vector3::new(k[0] * l.x, k[1] * l.y, k[2] * l.z);
                let rate = (after - before) / (2.0 * h);
                assert!(
                    (rate - omega.cross_matrix() * frame).amax() < 2e-8,
                    "{k:?} {direction:?} {t}: {rate} {}",
                    omega.cross_matrix() * frame
                );
                let squares = (squares_after - squares_before) / (2.0 * h) + top.mean_squares();
                assert!((squares - l.component_mul(&l)).amax() < 2e-8, "{k:?} {direction:?} {t}: {squares}");
            }
            let mean = (0..240)
                .map(|j| at(&top, period * f64::from(j) / 240.0).0.column(2).map(|x| x * x))
                .sum::<Vector3<f64>>()
                / 240.0;
            assert_relative_eq!(mean, top.mean_squares(), epsilon = 1e-9);
            assert_relative_eq!(at(&top, period).0.column(2), start.column(2), epsilon = 1e-13);
            // How near the separatrix: k'^2 by the amplitudes.
            let [a, b, c] = [k[0], k[1], k[2]].map(|x| x - 0.2);
            let parts = Vector3::new(a, b, c).component_mul(&l.component_mul(&l));
            let positive: f64 = parts.iter().filter(|x| **x > 0.0).sum();
            let negative: f64 = -parts.iter().filter(|x| **x < 0.0).sum::<f64>();
            let (large, small) = (positive.max(negative), positive.min(negative));
            let gaps = if positive > negative { (0.7, 0.6) } else { (0.6, 0.7) };
            // A_1^2 b' against A_3^2 b: k^2 = a A_1^2 / (b A_3^2), with the square along the middle axis taken out.
            let middle_square = l[middle] * l[middle];
            let parameter = small_over(large, small, gaps, middle_square);
            assert_relative_eq!(top.complement().powi(2), 1.0 - parameter, epsilon = 1e-14);
            seen += 1;
        }
    }
    assert_eq!(seen, 48);
}

/// `k^2` of a top: `l` goes round the axis whose part is `large`; where its square along the middle axis vanishes, `A_1^2` and `A_3^2` are left.
fn small_over(large: f64, small: f64, (gap_round, gap_other): (f64, f64), middle: f64) -> f64 {
    // Squares along both outer axes at hand, then those at the passage of the plane without the middle axis.
    let (x, z) = (small / gap_other, large / gap_round);
    // d(x) / d(middle) at constant energy: gap_round z - gap_other x is constant, and x + z + middle is one.
    let share = gap_round / (gap_round + gap_other);
    let (first, third) = (x + middle * share, z + middle * (1.0 - share));
    gap_other * first / (gap_round * third)
}

/// On the separatrix `l` goes from one end of the middle axis to the other, once.
#[test]
fn a_top_on_the_separatrix_turns_with_its_angular_velocity() {
    // Gaps of four and one: the larger outer part is twice the smaller one, exactly.
    let x: f64 = 0.3125;
    let middle = (1.0 - 5.0 * x * x).sqrt();
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
        for signs in 0..8 {
            let sign = |bit: u32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
            let (mut k, mut l) = ([0.0; 3], Vector3::zeros());
            for (place, (value, part)) in order.into_iter().zip([(4.5, x), (0.5, middle), (-0.5, 2.0 * x)]) {
                (k[place], l[place]) = (value, part * sign(place as u32));
            }
            let top = Top::new(k, &l);
            assert!(!top.goes_round() && top.complement() == 0.0, "{k:?} {l}");
            assert_relative_eq!(at(&top, 0.0).0.column(2).into_owned(), l, epsilon = 1e-14);
            let h = 1e-4;
            for j in -8..=8 {
                let t = 0.21 * f64::from(j);
                let [(before, squares_before), (frame, _), (after, squares_after)] =
                    [-h, 0.0, h].map(|h| at(&top, t + h));
                let l = frame.column(2).into_owned();
                let omega = Vector3::new(k[0] * l.x, k[1] * l.y, k[2] * l.z);
                let rate = (after - before) / (2.0 * h);
                assert!((rate - omega.cross_matrix() * frame).amax() < 3e-7, "{k:?} {l} {t}: {rate}");
                let squares = (squares_after - squares_before) / (2.0 * h) + top.mean_squares();
                assert!((squares - l.component_mul(&l)).amax() < 3e-7, "{k:?} {t}: {squares}");
            }
        }
    }
    // Long before and after it is on the middle axis.
    let top = Top::new([4.5, 0.5, -0.5], &Vector3::new(x, middle, 2.0 * x));
    let ends = [-900.0, 900.0].map(|phase| top.at(phase).frame.column(2).into_owned());
    assert_relative_eq!(ends[0], -ends[1], epsilon = 1e-15);
    assert_relative_eq!(ends[1].abs(), Vector3::y(), epsilon = 1e-15);
    // On the middle axis nothing moves.
    let still = Top::new([4.5, 0.5, -0.5], &Vector3::new(0.0, -1.0, 0.0));
    assert!(still.complement() == 1.0);
    assert_eq!((still.rates.slow, still.rates.about), (0.0, 0.5));
    assert_eq!(still.at(0.7).frame.column(2).into_owned(), Vector3::new(0.0, -1.0, 0.0));
}

/// The derivative of a top by its values and its start, against a difference.
#[test]
fn derivatives_of_a_top_are_those_of_its_motion() {
    let (k, l) = ([0.9, 0.2, -0.4], Vector3::new(0.3, 0.5, 0.8).normalize());
    let (by_k, by_l) = ([0.3, -0.7, 0.2], l.cross(&Vector3::new(0.4, -0.2, 0.9)));
    let position = |h: f64| {
        let k = [0, 1, 2].map(|i| k[i] + h * by_k[i]);
        let l = (l + by_l * h).normalize();
        at(&Top::new(k, &l), 7.3)
    };
    let h = 1e-5;
    let (after, before) = (position(h), position(-h));
    let top = Top::new([0, 1, 2].map(|i| Dual64::new(k[i], by_k[i])), &l.zip_map(&by_l, Dual64::new));
    let rates = top.rates;
    let shape = top.at(top.start + rates.slow * 7.3);
    let about = rates.about * 7.3 + shape.turned[1].atan2(shape.turned[0]);
    let (sin, cos) = about.sin_cos();
    let column = shape.frame.column(0) * cos + shape.frame.column(1) * sin;
    let exact = (after.0 - before.0) / (2.0 * h);
    assert_relative_eq!(column.map(|x| x.eps), exact.column(0).into_owned(), epsilon = 1e-8);
    assert_relative_eq!(shape.frame.column(2).map(|x| x.eps), exact.column(2).into_owned(), epsilon = 1e-8);
    let squares = top.squares(shape.integral).map(|x| x.eps);
    assert_relative_eq!(squares, (after.1 - before.1) / (2.0 * h), epsilon = 1e-8);
}
