//! dump
use std::time::Instant;
use twofold::propagation::{Motion, propagate};
use twofold_verify::check::largest;
use twofold_verify::estimate_scenes::EstimateScene;
/// dump
fn main() {
    let a: Vec<u64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    for number in a[1]..a[2] {
        let scene = EstimateScene::draw(a[0], number);
        let t0 = Instant::now();
        let motion = match propagate(&scene.spheroid, &scene.violation, &scene.initial, scene.span, scene.accuracy) {
            Ok(m) => m,
            Err(e) => {
                eprintln!("{number}: {e}");
                continue;
            }
        };
        let t1 = Instant::now();
        let parts = motion.error_parts(scene.time);
        let t2 = Instant::now();
        let state = motion.state(scene.time).unwrap();
        let e = scene.true_errors(&state);
        let t3 = Instant::now();
        let rate = scene.momentum_unit() / scene.spheroid.inertia_xx;
        let tc = (scene.spheroid.inertia_xx / scene.spheroid.constant_c.abs()).sqrt();
        println!(
            "{number} {:e} {:e} {:e} {:e} {:e} {:e} {} {} {:e} {:e} {} {} {} {} {} {:e} {:e}",
            e[0],
            e[1],
            e[2],
            parts[0],
            parts[1],
            parts[2],
            motion.step_count(),
            motion.order(),
            scene.accuracy,
            scene.strength,
            scene.near_middle_axis as u8,
            (scene.time - scene.span.0).abs() * rate,
            (t1 - t0).as_nanos(),
            (t2 - t1).as_nanos(),
            (t3 - t2).as_nanos(),
            scene.initial.momentum.norm() / scene.spheroid.inertia_xx * tc,
            largest(e)
        );
    }
}
