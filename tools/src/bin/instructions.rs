//! The hot kernels, one at a time, for `scripts/instructions`, which counts their instructions:
//!
//! ```sh
//! cargo run --release -p twofold-tools --bin instructions -- KERNEL REPEATS
//! ```
//!
//! Without a kernel it lists them. Reading the scene and starting the program count, too; the script takes the difference of
//! two numbers of repeats.

use std::hint::black_box;

use twofold::observables::Observer;
use twofold::observables::pulsar::{Beam, pulse_train};
use twofold::propagation::{Motion, TaylorMotion};
use twofold_bench::method::{MANY_SCENES, METHODS};
use twofold_bench::scene::BenchScene;

/// Length of the motions (t_c), and their tolerance.
const DURATION: f64 = 100.0;
const TOLERANCE: f64 = 1e-12;

type Kernel = fn(&BenchScene, &TaylorMotion<f64>, usize);

/// Names, and the work of one repeat.
const KERNELS: [(&str, Kernel); 6] = [
    ("taylor-axis", |scene, _, _| {
        drop(black_box(scene.problem.reduced().taylor((0.0, DURATION), TOLERANCE)));
    }),
    ("taylor-orientation", |scene, _, _| drop(black_box(motion(scene)))),
    ("sample-axis", |_, motion, i| {
        drop(black_box(motion.axis_state(DURATION * ((i * 7) % 100) as f64 / 100.0)));
    }),
    ("sample-orientation", |_, motion, i| {
        drop(black_box(motion.state(DURATION * ((i * 7) % 100) as f64 / 100.0)));
    }),
    ("pulse-train", |_, motion, _| {
        let (beam, observer) = (Beam::new(0.5, 0.0, 0.6), Observer::at(0.8, 0.0));
        drop(black_box(pulse_train(motion, &beam, &observer.direction, (0.0, DURATION))));
    }),
    ("eight-scenes", |scene, _, _| drop(black_box((MANY_SCENES[0].0.run)(scene, DURATION, TOLERANCE)))),
];

fn motion(scene: &BenchScene) -> TaylorMotion<f64> {
    scene.problem.taylor((0.0, DURATION), TOLERANCE).expect("a motion within the limits")
}

fn main() {
    let mut args = std::env::args().skip(1);
    let scene = BenchScene::named("tp-II");
    let Some(name) = args.next() else {
        KERNELS.iter().for_each(|(name, _)| println!("{name}"));
        // Without numeris, which is only a baseline, and Taylor, whose kernels are above.
        let others = METHODS.iter().filter(|method| !method.name.starts_with("numeris") && method.name != "Taylor");
        others.for_each(|method| println!("{}/{}", method.name, method.carries));
        return;
    };
    let repeats: usize = args.next().and_then(|text| text.parse().ok()).unwrap_or(1);
    let motion = motion(&scene);
    if let Some((_, kernel)) = KERNELS.iter().find(|(kernel, _)| *kernel == name) {
        (0..repeats).for_each(|i| kernel(&scene, &motion, i));
        return;
    }
    let of_name = METHODS.iter().find(|method| format!("{}/{}", method.name, method.carries) == name);
    let method = of_name.unwrap_or_else(|| panic!("no kernel is called {name}"));
    let setting = method.settings[method.settings.len() / 2];
    (0..repeats).for_each(|_| drop(black_box((method.run)(&scene, DURATION, setting))));
}
