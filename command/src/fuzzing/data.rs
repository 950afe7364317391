//! Tables of numbers: the authors' files, measured series, tables of pulsars.

use std::sync::OnceLock;

use crate::compare::compare_text;
use twofold::inference::{Observable, Place, fit};
use twofold::parameters::Parameter;
use twofold_scene::measurements::{DataFile, parameters_of};
use twofold_scene::pulsar_table::pulsars as read_pulsars;
use twofold_scene::scene_file::{Scene, built_in};

/// One of the authors' files, chosen by the first byte and cut to the rows that exist.
pub fn authors_data(bytes: &[u8]) {
    let Some((kind, text)) = bytes.split_first() else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    let rows = text.lines().count().clamp(1, 16);
    if let Some(Ok(report) | Err(report)) = compare_text(usize::from(*kind % 12), text, rows) {
        assert!(!report.is_empty());
    }
}

/// A short motion of tp-1.
fn scene() -> &'static Scene {
    static SCENE: OnceLock<Scene> = OnceLock::new();
    SCENE.get_or_init(|| {
        let text = built_in("tp-1").expect("a scene").toml.replace("span = 400", "span = 30");
        Scene::from_toml("tp-1", &text).expect("a scene")
    })
}

/// A table of pulses or of strains, and a fit to it if it has few rows within the span of a scene.
pub fn data_file(bytes: &[u8]) {
    const MOST_FITTED: usize = 40;
    let Some((kinds, table)) = bytes.split_first() else { return };
    let Ok(table) = DataFile::of_bytes("data.csv", table.to_vec()) else { return };
    let noise: Vec<_> = (0..6).filter(|k| kinds >> k & 1 == 1).map(|k| (Observable::ALL[k], 1e-3)).collect();
    let read = match table.is_of_pulses() {
        Ok(true) => table.pulses(scene(), &noise).map(|(data, _)| data),
        Ok(false) => table.strain(scene(), &noise),
        Err(why) => Err(why),
    };
    let data = match read {
        Ok(data) => data,
        Err(why) => return assert!(why.starts_with("data.csv"), "{why}"),
    };
    let Ok(parameters) = parameters_of(scene()) else { return };
    let within = |time: f64| (0.0..=30.0).contains(&time);
    let is_within = data.iter().all(|datum| match datum.place {
        Place::Time(time) | Place::Turn { near: time, .. } => within(time),
    });
    if is_within && data.len() <= MOST_FITTED && *kinds >= 192 {
        let _ = fit(&parameters, &data, &[Parameter::Chi, Parameter::Rho], 30.0);
    }
}

/// The text of a table of pulsars, with every number derived from it.
pub fn pulsars(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match read_pulsars("pulsars.toml", text) {
        Err(refusal) => assert!(!refusal.to_string().is_empty()),
        Ok(pulsars) => {
            for pulsar in pulsars {
                let figures = pulsar.figures().expect("a table is refused where a bound does not exist");
                for figure in figures {
                    assert!(figure.value.is_finite(), "{}: {} = {}", pulsar.name, figure.key, figure.value);
                }
                let figure = pulsar.figure("bound_over_eta_own").expect("every pulse has one");
                let limit = pulsar.limit(&figure).expect("a table is refused where a limit does not exist").all;
                assert!(limit.is_finite() && limit > 0.0, "{}: limit {limit}", pulsar.name);
            }
        }
    }
}
