//! `twofold figures` as a user sees it: files, names, refusals.

use crate::common::{Folder, names_in, stdout, succeeds};

#[test]
fn a_figure_has_its_four_kinds_of_files() {
    let folder = Folder::new();
    assert_eq!(stdout(&folder.succeeds(&["figures", "waves", "1"])), "figures: 2 figures, 9 files\n");
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
    assert_eq!(names_in(&folder.at("figures")), expected);
    let png = folder.bytes("figures/waves.png");
    assert!(png.starts_with(b"\x89PNG"));
    // 17.8 cm at 300 pixels per inch.
    assert_eq!(u32::from_be_bytes(png[16..20].try_into().expect("width")), 2103);
    let csv = folder.read("figures/waves.tp-I.csv");
    assert!(csv.starts_with("t [t_c],h_+ [G I^xx / (c^4 t_c^2 r)],h_x"), "{}", &csv[..80]);
    assert_eq!(csv.lines().count(), 2002);
    let caption = folder.read("figures/waves.md");
    assert!(caption.contains("(Figure 11 of the paper)") && caption.contains("`waves.tp-II.csv`"), "{caption}");
}

#[test]
fn every_figure_is_listed_with_its_number() {
    let text = stdout(&succeeds(&["figures", "--list"]));
    for number in 1..=12 {
        assert_eq!(text.matches(&format!("Fig. {number} ")).count(), 1, "{number} in\n{text}");
    }
    let page = include_str!("../../../docs/figures.md");
    for name in text.lines().filter_map(|line| line.split_whitespace().next()) {
        assert!(page.contains(&format!("`{name}`")), "docs/figures.md does not name `{name}`");
    }
}
