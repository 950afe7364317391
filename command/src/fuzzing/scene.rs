//! Scene files.

use twofold_scene::pulsar_timing::{PulsarScene, csv, par, tim};
use twofold_scene::scene_file::Scene;
use twofold_scene::trajectory::{write_csv, write_pulses};

/// Largest rotation (rad) and number of samples of a scene that is computed completely.
const ROTATION: f64 = 200.0;
const SAMPLES: usize = 64;

/// The text of a scene file: read, planned and, if the work is small, run.
pub fn scene(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Scene::from_toml("scene.toml", text) {
        Ok(scene) => run(&scene),
        Err(refusal) => assert!(!refusal.to_string().is_empty()),
    }
}

/// Whether a scene is little work for any request.
pub(super) fn is_small(scene: &Scene) -> bool {
    scene.rotation() <= ROTATION && scene.times.count() <= SAMPLES
}

fn run(scene: &Scene) {
    let Ok(plan) = scene.plan(&scene.columns) else { return };
    let is_short = is_small(scene);
    if is_short || plan.costs_the_same_at_any_time() && scene.times.count() <= SAMPLES {
        let mut table = Vec::new();
        if write_csv(scene, &mut table, |_| Ok(())).is_ok() {
            are_finite(&table);
        }
    }
    if is_short {
        let _ = write_pulses(scene, std::io::sink(), |_| Ok(()));
    }
    if let (Ok(pulsar), true) = (PulsarScene::new(scene), scene.times.count() <= SAMPLES) {
        let start = scene.times.start();
        let epochs = scene.times.iter().map(|t| pulsar.epoch.after([t - start, 0.0])).collect::<Result<Vec<_>, _>>();
        let Some(Ok(timing)) = epochs.ok().map(|epochs| pulsar.timed(&epochs, 2)) else { return };
        let causes = pulsar.causes(&timing).ok();
        let _ = (csv(&pulsar, &timing, causes.as_ref()), par(scene, &timing), tim(&timing, 1e-6));
    }
}

/// Every field of a table after its header is a finite number or empty.
pub(super) fn are_finite(table: &[u8]) {
    let text = std::str::from_utf8(table).expect("a table is text");
    for field in text.lines().skip(1).flat_map(|line| line.split(',')) {
        let is_finite = field.is_empty() || field.parse::<f64>().is_ok_and(f64::is_finite);
        assert!(is_finite, "a field is `{field}`");
    }
}
