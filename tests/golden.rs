//! The paper's numbers beside ours, as snapshots for review in `golden/`.

#[test]
fn golden_tables_are_as_reviewed() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../golden");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for table in twofold_verify::golden::tables().expect("the golden numbers can be computed") {
            insta::assert_snapshot!(table.name, table.to_string());
        }
    });
}
