//! Sweep files.

use super::scene::is_small;
use twofold_scene::scene_file::{SceneError, built_in};
use twofold_scene::sweep::{Sweep, SweepText};

/// Separator between the text of a sweep and that of its scene.
const BETWEEN: &str = "\n%%\n";

/// The texts of a sweep file and, after `%%`, of the scene that it names: read and, if the work is small, computed in part.
pub fn sweep(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let (text, scene) = text.split_once(BETWEEN).map_or((text, None), |(text, scene)| (text, Some(scene)));
    let find = |name: &str| match (built_in(name), scene) {
        (Some(built_in), _) => Ok((name.to_owned(), built_in.toml.to_owned())),
        (None, Some(text)) => Ok((name.to_owned(), text.to_owned())),
        (None, None) => Err(SceneError::of_file(name, "is not there")),
    };
    let read = SweepText::with("sweep.toml", text.to_owned(), find);
    match read
        .as_ref()
        .map_err(ToString::to_string)
        .and_then(|text| Sweep::new(text).map_err(|error| error.to_string()))
    {
        Ok(sweep) => first_rows(&sweep),
        Err(refusal) => assert!(!refusal.is_empty()),
    }
}

fn first_rows(sweep: &Sweep<'_>) {
    const ROWS: u64 = 3;
    for number in (0..sweep.scenes.min(ROWS)).chain([sweep.scenes - 1]) {
        if sweep.scene(number).is_ok_and(|scene| !is_small(&scene)) {
            continue;
        }
        let ([rows, errors], _) = sweep.rows(number..number + 1);
        let text = String::from_utf8(rows).expect("a table is text");
        assert_eq!(text.lines().count(), 1);
        let columns = text.trim_end().split(',').collect::<Vec<_>>();
        assert_eq!(columns.len(), sweep.header().len(), "{text}");
        let is_number = |field: &&str| field.is_empty() || field.parse::<f64>().is_ok_and(f64::is_finite);
        assert!(columns.iter().all(|field| is_number(field) || ["ok", "failed"].contains(field)), "{text}");
        let errors = String::from_utf8(errors).expect("a table is text");
        assert!(!errors.contains("a bug in this program"), "{errors}");
    }
}
