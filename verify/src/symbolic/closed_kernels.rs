//! Kernels with roots or inverse functions, with the names and the order of components of `verify/oracles/symbolic/quantities.py`.

use twofold::observables::wave_harmonics::WaveHarmonics;
use twofold::spin_down::{Braking, Precession as FreePrecession, StretchedTime};

use super::{ClosedKernel, RationalPoint};
use crate::prelude::*;

type Point = RationalPoint<f64>;
type Components = Result<Vec<f64>, Error>;
type Values = fn(&Point) -> Components;

pub(super) fn all() -> Vec<ClosedKernel> {
    let kernels: [(&str, Values); 17] = [
        ("potential-coefficients", |p| {
            let a = potential_coefficients(&SpheroidShape::from_axis_ratio(p.at("q"))?);
            Ok(vec![a.a0, a.a1, a.a3, a.difference])
        }),
        ("uniform-spheroid", |p| {
            let star = UniformSpheroid::new(p.at("a_1"), p.at("rho"), SpheroidShape::from_axis_ratio(p.at("q"))?)?;
            let (inertia, energies) = (star.moment_of_inertia(), star.potential_energy_tensor());
            let rotating = MaclaurinSpheroid::new(star)?;
            Ok(vec![
                star.mass(),
                inertia.xx,
                inertia.zz,
                energies.xx,
                energies.zz,
                star.c(),
                star.shape.oblateness(),
                star.polar_inertia_over_c()?,
                rotating.rotation_rate_squared,
                rotating.rotational_energy,
            ])
        }),
        ("inertia-over-c", |p| {
            Ok(vec![inertia_over_c_estimate(p.at("rho"), p.at("x_1")), fluid_inertia_over_c(p.at("spin"))])
        }),
        ("mean-potential", |p| {
            let (s, n, l) = mean_point(p);
            let value = |order| mean_potential(&p.spheroid(), &s, p.at("size"), n.dot(&l), &l, order);
            Ok(vec![value(AveragingOrder::First), value(AveragingOrder::Second)])
        }),
        ("mean-angular-velocity-first", |p| mean_rate(p, AveragingOrder::First)),
        ("mean-angular-velocity-second", |p| mean_rate(p, AveragingOrder::Second)),
        ("generator", |p| {
            let (s, n, l) = mean_point(p);
            Ok(vec![generator(&p.spheroid(), &s, &n, &(l * p.at("size")))])
        }),
        ("generator-slopes", |p| {
            let (s, n, l) = mean_point(p);
            Ok(generator_slopes(&p.spheroid(), &s, &n, &(l * p.at("size"))).iter().flatten().copied().collect())
        }),
        // At the energy of the first-order averaged motion on the middle axis, for the size G and the cosine c of the point.
        ("growth-at-middle-axis", |p| {
            let (spheroid, s, size, cosine) = (p.spheroid(), p.coefficients(), p.at("size"), p.at("x_1"));
            let mean = (s.xx + s.yy + s.zz) / 3.0;
            let along = size * cosine;
            let spin = along / spheroid.inertia_zz;
            let energy = size * size / (2.0 * spheroid.inertia_xx)
                + spheroid.constant_c * ((3.0 * cosine * cosine - 1.0) / 2.0 * (s.yy - mean) + mean)
                + along * spin / 2.0
                - along * along / (2.0 * spheroid.inertia_xx);
            Ok(vec![middle_axis_growth(&spheroid, &s, energy, spin, AveragingOrder::First)?])
        }),
        ("steady-precession", |p| {
            let (xx, zz) = (p.at("s_x"), p.at("s_z"));
            let s = PrincipalCoefficients { xx, yy: xx, zz };
            let rate = |kind| steady_precession_rate(kind, &p.spheroid(), &s, p.at("spin"), p.at("beta"));
            Ok(vec![rate(Precession::Twofold)?, rate(Precession::Single)?])
        }),
        ("free-precession", |p| {
            let rates = free_precession_rates(&p.spheroid(), p.at("spin"), p.at("beta"))?;
            Ok(vec![rates.alpha, rates.gamma])
        }),
        ("free-rotation", |p| {
            let rates = free_precession_rates(&p.spheroid(), p.at("spin"), p.at("beta"))?;
            let start = BodyState::from_angles(&p.spheroid(), &p.angles(), &rates);
            let start = start.rotated(&body_from_inertial(&p.frame()).transpose());
            let later = free_rotation(&p.spheroid(), &start, p.at("x_1"));
            Ok(later.axis.iter().chain(&later.equatorial_axis).copied().collect())
        }),
        // `L` along Z, the axis at the colatitude and azimuth of the point, the observer at the inclination `zeta` and azimuth zero.
        ("wave-harmonics", |p| {
            let (theta, phi) = (p.at("colatitude"), p.at("azimuth"));
            let ((sin_theta, cos_theta), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
            let axis = Vector3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta);
            let state = AxisState { axis, momentum: Vector3::z() * p.at("size") };
            let found = WaveHarmonics::of(&p.spheroid(), &state, &Observer::at(p.at("zeta"), 0.0))?;
            let along_momentum = WaveHarmonics { orientation: 0.0, ..found }.polarizations();
            Ok(vec![along_momentum.plus, along_momentum.cross, found.once, found.twice])
        }),
        ("spin-axis-bound", |p| {
            let polar_inertia_over_c = p.at("i_zz") / p.at("c");
            let (spin, interval, cos_lambda_change) = (p.at("spin"), p.at("x_1"), p.at("x_2"));
            let drift = SpinAxisDrift { polar_inertia_over_c, spin, interval, cos_lambda_change };
            Ok(vec![drift.combination_bound(eta_from_inclination(p.at("beta"))?)?])
        }),
        ("braked-rotation", |p| {
            let tau = stretched(p);
            let [time, rest] = braked(p, 3.0)?.time_at([tau, 0.0]);
            Ok(vec![braked(p, 2.0 + p.at("x_4"))?.slowing(tau), time + rest])
        }),
        ("delay-by-torque", |p| Ok(vec![braked(p, 3.0)?.delay(stretched(p))])),
        ("damped-wobble", |p| {
            let (damped, tau) = (precession(p, p.at("x_5") / 16.0), stretched(p));
            Ok(vec![damped.wobble_at(tau), damped.ahead(tau)])
        }),
    ];
    kernels.map(|(name, values)| ClosedKernel { name, values }).to_vec()
}

fn stretched(p: &Point) -> f64 {
    16.0 * p.at("x_2")
}

fn precession(p: &Point, damping: f64) -> FreePrecession {
    FreePrecession::new(["colatitude", "chi", "azimuth"].map(|name| p.at(name)), p.at("size"), damping)
}

fn braked(p: &Point, index: f64) -> Result<StretchedTime, Error> {
    StretchedTime::new(&Braking { rate: p.at("x_1") / 1024.0, index, torque_share: p.at("x_3") }, &precession(p, 0.0))
}

/// Traceless principal values, `n` and the direction of `L`.
fn mean_point(p: &Point) -> (Vector3<f64>, Vector3<f64>, Vector3<f64>) {
    let (x, y) = (p.at("s_x"), p.at("s_y"));
    let axis = |rotation: Matrix3<f64>| rotation.row(2).transpose();
    (Vector3::new(x, y, -x - y), axis(body_from_inertial(&p.angles())), axis(body_from_inertial(&p.frame())))
}

fn mean_rate(p: &Point, order: AveragingOrder) -> Components {
    let (s, n, l) = mean_point(p);
    let (along_l, tensor, along_n) = mean_angular_velocity(&p.spheroid(), &s, p.at("size"), n.dot(&l), &l, order);
    Ok((l * along_l + tensor.component_mul(&l) + n * along_n).as_slice().to_vec())
}
