//! `twofold figures` as a user meets it: files, names, refusals.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::{ends, folder, has_all, names_in, stderr};

fn figures(folder: &Path, args: &[&str]) -> Output {
    let command = Command::new(env!("CARGO_BIN_EXE_twofold")).arg("figures").args(args).current_dir(folder).output();
    command.expect("the command starts")
}

#[test]
fn a_figure_has_its_four_kinds_of_files() {
    let folder = folder();
    let output = ends(figures(folder.path(), &["waves", "1"]), 0);
    assert_eq!(String::from_utf8_lossy(&output.stdout), "figures: 2 figures, 9 files\n");
    let made = folder.path().join("figures");
    let expected = [
        "euler-angles.csv",
        "euler-angles.md",
        "euler-angles.png",
        "euler-angles.svg",
        "waves.md",
        "waves.png",
        "waves.svg",
        "waves.tp-I.csv",
        "waves.tp-II.csv",
    ];
    assert_eq!(names_in(&made), expected);
    let png = fs::read(made.join("waves.png")).expect("PNG");
    assert!(png.starts_with(b"\x89PNG"));
    // 17.8 cm at 300 pixels per inch.
    assert_eq!(u32::from_be_bytes(png[16..20].try_into().expect("width")), 2103);
    let csv = fs::read_to_string(made.join("waves.tp-I.csv")).expect("CSV");
    assert!(csv.starts_with("t [t_c],h_+ [G I^xx / (c^4 t_c^2 r)],h_x"), "{}", &csv[..80]);
    assert_eq!(csv.lines().count(), 2002);
    let caption = fs::read_to_string(made.join("waves.md")).expect("caption");
    assert!(caption.contains("(Figure 11 of the paper)") && caption.contains("`waves.tp-II.csv`"), "{caption}");
}

#[test]
fn nothing_is_replaced_unless_asked() {
    let folder = folder();
    let made = folder.path().join("figures");
    fs::create_dir(&made).expect("folder");
    for (file, text) in [("beam-cone.svg", "mine"), ("beam-cone.pdf", "mine"), ("notes.txt", "mine")] {
        fs::write(made.join(file), text).expect("file");
    }
    let refused = ends(figures(folder.path(), &["beam-cone", "--out", "figures"]), 2);
    has_all(&stderr(&refused), &["--out figures: beam-cone.svg exists there; --force replaces it"]);
    assert_eq!(names_in(&made), ["beam-cone.pdf", "beam-cone.svg", "notes.txt"]);
    assert_eq!(fs::read(made.join("beam-cone.svg")).expect("file"), b"mine");

    fs::create_dir(made.join("waves.png")).expect("folder");
    let not_a_file = ends(figures(folder.path(), &["waves", "--force"]), 2);
    has_all(&stderr(&not_a_file), &["waves.png exists there and is not a regular file"]);
    assert_eq!(names_in(&made), ["beam-cone.pdf", "beam-cone.svg", "notes.txt", "waves.png"]);

    ends(figures(folder.path(), &["beam-cone", "--force"]), 0);
    assert!(fs::read(made.join("beam-cone.svg")).expect("file").starts_with(b"<svg"));
    for untouched in ["beam-cone.pdf", "notes.txt"] {
        assert_eq!(fs::read(made.join(untouched)).expect("file"), b"mine");
    }
}

#[test]
fn bad_input_is_refused_before_anything_is_made() {
    let folder = folder();
    fs::write(folder.path().join("file"), "mine").expect("file");
    for (args, fragment) in [
        (&["wave"][..], "no figure is called `wave`. Did you mean `waves`? There are euler-angles, "),
        (&["13"], "no figure is called `13`."),
        (&["motion-tp-1", "--scene", "tp-1"], "There are motion, beam-alignment, "),
        (&["--scene", "tp-11"], "did you mean `tp-1`?"),
        (&["waves", "--out", "file"], "--out file: exists and is not a folder"),
        (&["waves", "--out", "file/below"], "--out file/below: no folder can be made"),
    ] {
        let output = figures(folder.path(), args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(fragment), "{args:?}: {}", stderr(&output));
        assert!(output.stdout.is_empty());
    }
    assert_eq!(names_in(folder.path()), ["file"]);
}

#[test]
fn a_scene_has_the_figures_for_which_it_has_sections() {
    let folder = folder();
    let text = "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.02, 0.01, -0.04]\n\
                [initial]\nalpha = 0.0\nbeta = 0.7\nalpha_rate = 1.5\nbeta_rate = 0.0\n[time]\nspan = -30.0\nsamples = 2\n";
    fs::write(folder.path().join("my-star.toml"), text).expect("scene");
    let output = ends(figures(folder.path(), &["--scene", "my-star.toml", "--out", "all"]), 0);
    assert_eq!(stderr(&output).matches("the scene lacks the section [observer]").count(), 5, "{}", stderr(&output));
    let made = names_in(&folder.path().join("all"));
    assert_eq!(made, ["motion.angles.csv", "motion.md", "motion.paths.csv", "motion.png", "motion.svg"]);

    let named = ends(figures(folder.path(), &["waves", "--scene", "my-star.toml", "--out", "none"]), 2);
    has_all(&stderr(&named), &["error: my-star.toml: the scene lacks the section [observer]"]);
    assert!(!folder.path().join("none").exists());
}

#[test]
fn the_strain_of_a_physical_star_needs_its_distance() {
    let folder = folder();
    let text = "[star]\nmass = 1.4\nradius = 12.0\noblateness = 1e-3\nspin_frequency = 100.0\n[lorentz_violation]\n\
                eigenvalues = [0.0, 0.0, 0.0]\n[initial]\nalpha = 0.0\nbeta = 0.5\nalpha_rate = 700.0\nbeta_rate = 0.0\n[observer]\n\
                theta_o = 0.8\nphi_o = 0.0\n[time]\nspan = 2.0\nsamples = 3\n";
    fs::write(folder.path().join("near.toml"), text).expect("scene");
    let lacking = "the scene lacks `observer.distance` [kpc], without which a physical star has no strain";
    let output = ends(figures(folder.path(), &["waves", "--scene", "near.toml"]), 2);
    assert!(stderr(&output).contains(&format!("error: near.toml: {lacking}")), "{}", stderr(&output));

    let far = text.replace("phi_o = 0.0", "phi_o = 0.0\ndistance = 2.0");
    fs::write(folder.path().join("far.toml"), far).expect("scene");
    ends(figures(folder.path(), &["waves", "--scene", "far.toml"]), 0);
    let made = folder.path().join("figures");
    let csv = fs::read_to_string(made.join("waves.far.csv")).expect("CSV");
    assert!(csv.starts_with("t [s],h_+ [1],h_x [1]\n0.0,"), "{}", &csv[..60]);
    let caption = fs::read_to_string(made.join("waves.md")).expect("caption");
    has_all(&caption, &["as strain at 2 kpc", "*ε* = 0.001,", "/(2π) = 100 Hz", "time in s."]);
}

#[test]
fn every_figure_is_listed_with_its_number() {
    let folder = folder();
    let output = figures(folder.path(), &["--list"]);
    let text = String::from_utf8(output.stdout).expect("text");
    for number in 1..=12 {
        assert_eq!(text.matches(&format!("Fig. {number} ")).count(), 1, "{number} in\n{text}");
    }
    assert!(names_in(folder.path()).is_empty());
    let page = include_str!("../../../docs/figures.md");
    for name in text.lines().filter_map(|line| line.split_whitespace().next()) {
        assert!(page.contains(&format!("`{name}`")), "docs/figures.md does not name `{name}`");
    }
}
