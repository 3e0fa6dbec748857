//! Notation such as (010)-(1L1): parsing, formatting, and errors that name the row.

use proptest::prelude::*;
use teeter_scene::{Cell, LOOSE_CLEARANCE, Notation, TowerOptions, config, loose};

fn cell() -> impl Strategy<Value = Cell> {
    prop_oneof![Just(Cell::Absent), Just(Cell::Present), Just(Cell::Loose)]
}

fn row() -> impl Strategy<Value = [Cell; 3]> {
    prop::array::uniform3(cell()).prop_filter("a row has a block", |row| row != &[Cell::Absent; 3])
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, max_local_rejects: 1_000_000, ..ProptestConfig::default() })]

    #[test]
    fn formatted_notation_parses_back(rows in prop::collection::vec(row(), 1..=200)) {
        let notation = Notation { rows };
        prop_assert_eq!(notation.to_string().parse::<Notation>().unwrap(), notation);
    }

    #[test]
    fn parsing_never_panics(text in ".{0,40}") {
        let _ = text.parse::<Notation>();
        let _ = Notation::from_loose_map(&text);
    }
}

#[test]
fn columns_run_from_left_to_right() {
    let scene = config("(100)-(001)", &TowerOptions::exact()).unwrap();
    assert_eq!(scene.blocks[0].pos[..2], [0.0, -0.0271]);
    assert_eq!(scene.blocks[1].pos[..2], [0.0271, 0.0]);
    assert_eq!(scene.name, "(100)-(001)");
}

#[test]
fn absent_blocks_leave_the_others_unchanged() {
    let options = TowerOptions::default();
    let full = config("(111)-(111)", &options).unwrap();
    let partial = config("(101)-(111)", &options).unwrap();
    assert_eq!(full.blocks[2].size, partial.blocks[1].size);
    assert_eq!(full.blocks[3].mass, partial.blocks[2].mass);
}

#[test]
fn a_loose_block_has_a_gap_above_it() {
    let scene = config("(1L1)-(111)", &TowerOptions::exact()).unwrap();
    let top = |i: usize| scene.blocks[i].pos[2] + scene.blocks[i].size[2] / 2.0;
    let bottom = scene.blocks[3].pos[2] - scene.blocks[3].size[2] / 2.0;
    assert!((bottom - top(1) - LOOSE_CLEARANCE).abs() < 1e-15);
    assert!((bottom - top(0)).abs() < 1e-15);
}

#[test]
fn a_loose_map_is_a_full_tower() {
    let scene = loose("(L00)-(00L)-(00L)-(0L0)-(L0L)-(LLL)", &TowerOptions::exact()).unwrap();
    assert_eq!(scene.blocks.len(), 18);
    let loose: Vec<usize> = (0..18).filter(|&i| scene.blocks[i].size[2] < 0.0179).collect();
    assert_eq!(loose, [0, 5, 8, 10, 12, 14, 15, 16, 17]);
    assert_eq!(scene.name, "(L11)-(11L)-(11L)-(1L1)-(L1L)-(LLL)");
}

#[test]
fn errors_name_the_row_and_the_expected_form() {
    let digits = "three of 0 (none), 1 (block) and L (loose block) in brackets, such as (011)";
    for (text, row, found, expected) in [
        ("", 1, "", digits),
        ("(010)-", 2, "", digits),
        ("(010)-(01)", 2, "(01)", digits),
        ("(010)-(010)-(0110)", 3, "(0110)", digits),
        ("010", 1, "010", digits),
        ("(012)", 1, "(012)", digits),
        ("(010)-(000)", 2, "(000)", "at least one block in every row"),
        ("(0101010101010101010101010101)", 1, "(0101010101010101010...", digits),
    ] {
        let error = config(text, &TowerOptions::exact()).unwrap_err().to_string();
        assert_eq!(error, format!("row {row} of the configuration is `{found}`, expected {expected}"));
    }
    let error = loose("(L00)-(100)", &TowerOptions::exact()).unwrap_err().to_string();
    assert_eq!(
        error,
        "row 2 of the configuration is `(100)`, expected three of 0 (ordinary) and L (loose) in brackets, such as (0L0)"
    );
    let error = config(&["(010)"; 201].join("-"), &TowerOptions::exact()).unwrap_err().to_string();
    assert_eq!(error, "row 201 of the configuration is `(010)`, expected at most 200 rows");
}
