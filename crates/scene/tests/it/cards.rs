//! Houses of cards: number and size of the cards, contact, and closed forms of their positions.

use glam::{DQuat, DVec3};
use teeter_scene::{Block, CardsOptions, MAX_STOREYS, Scene, cards, overlap};

const CARD: [f64; 3] = [0.094, 0.064, 0.0007];

/// Maximum gap or depth of cards that touch, m.
const TOUCH: f64 = 1e-9;

fn house(storeys: u32, edge_radius: f64) -> Scene {
    cards(storeys, &CardsOptions { edge_radius, ..CardsOptions::default() }).unwrap()
}

/// Sine and cosine of the angle of a leaning card.
fn lean() -> (f64, f64) {
    libm::sincos(65f64.to_radians())
}

/// Height of a leaning card from its lowest to its highest point, m: half edges of the core, and
/// the radius around it.
fn height(radius: f64) -> f64 {
    let (sin, cos) = lean();
    2.0 * ((0.032 - radius) * sin + (0.00035 - radius) * cos + radius)
}

/// Distance between the middles of two cards that lean against each other, m.
fn spread(radius: f64) -> f64 {
    let (sin, cos) = lean();
    2.0 * ((0.032 - radius) * cos + (0.00035 - radius) * sin + radius)
}

/// Normal of a card's face, upwards.
fn normal(card: &Block) -> DVec3 {
    let normal = DQuat::from_array(card.rotation()) * DVec3::Z;
    if normal.z < 0.0 { -normal } else { normal }
}

fn assert_near(a: f64, b: f64) {
    assert!((a - b).abs() < TOUCH, "{a} {b}");
}

#[test]
fn four_storeys_are_26_cards() {
    let scene = house(4, 1e-4);
    assert_eq!((scene.name.as_str(), scene.friction), ("cards-4", 0.7));
    assert!(scene.blocks.iter().all(|card| card.size == CARD && card.mass == 0.002));
    let level = scene.blocks.iter().filter(|card| normal(card).z > 0.9).count();
    assert_eq!((scene.blocks.len() - level, level), (20, 6));
    for storeys in 1..=MAX_STOREYS {
        let n = storeys as usize;
        assert_eq!(house(storeys, 1e-4).blocks.len(), n * (n + 1) + n * (n - 1) / 2);
    }
}

#[test]
fn the_first_storey_stands_on_the_floor_at_65_degrees() {
    for radius in [0.0, 1e-4, 2e-4] {
        let scene = house(4, radius);
        for (i, pair) in scene.blocks[..8].chunks(2).enumerate() {
            let apex = 0.07 * (i as f64 - 1.5);
            for (card, side) in pair.iter().zip([-1.0, 1.0]) {
                assert_near(card.pos[0], apex + side * 0.5 * spread(radius));
                assert_near(card.pos[1], 0.0);
                assert_near(card.pos[2], 0.5 * height(radius));
                assert_near(overlap::lowest_point(card, radius), 0.0);
                // The longer edge is level and across the row.
                let along = DQuat::from_array(card.rotation()) * DVec3::X;
                assert!((along.y.abs() - 1.0).abs() < 1e-15);
                let (sin, cos) = lean();
                assert!(normal(card).distance(DVec3::new(side * sin, 0.0, cos)) < 1e-15);
            }
            assert_near(overlap::rounded_depth(&pair[0], &pair[1], radius), 0.0);
        }
    }
}

/// Two cards lie on the four frames; the one between them lies on their ends.
#[test]
fn level_cards_lie_on_the_frames_and_on_their_neighbours() {
    for radius in [0.0, 1e-4] {
        let scene = house(4, radius);
        let top = height(radius) + 0.00035;
        for (card, x, z) in [(8, -0.07, top), (9, 0.07, top), (10, 0.0, top + 0.0007)] {
            let card = &scene.blocks[card];
            assert_near(card.pos[0], x);
            assert_near(card.pos[2], z);
            assert_eq!(card.orientation, None);
        }
    }
}

/// The outer frames of the second storey have a foot on the end of the higher card: they are turned
/// by the angle that lifts it by a thickness.
#[test]
fn a_frame_on_a_step_is_turned_by_its_height_over_the_distance_of_the_feet() {
    // Sharp edges: the feet are corners.
    let scene = house(4, 0.0);
    let (sin, cos) = lean();
    // The feet are the outer edges below: half the length outwards, half the thickness back.
    let feet = 2.0 * (0.5 * spread(0.0) + 0.032 * cos - 0.00035 * sin);
    let turn = libm::asin(0.0007 / feet);
    for (card, side) in [(11, -1.0), (12, 1.0)] {
        let (sin, cos) = libm::sincos(65f64.to_radians() + side * -turn);
        let expected = DVec3::new(side * sin, 0.0, cos);
        assert!(normal(&scene.blocks[card]).distance(expected) < 1e-9, "{card} {}", normal(&scene.blocks[card]));
    }
    // The middle frame stands on the higher card alone.
    assert_near(scene.blocks[13].pos[2] - scene.blocks[10].pos[2], 0.00035 + 0.5 * height(0.0));
}

/// No two cards overlap, and each has a support on either side of its centre, or leans and has one
/// below and one beside it.
#[test]
fn all_cards_touch_within_a_nanometre() {
    for (storeys, edge_radius, pitch) in [
        (1, 0.0, 0.07),
        (4, 0.0, 0.07),
        (4, 1e-4, 0.07),
        (4, 2.3e-4, 0.07),
        (12, 1e-4, 0.07),
        (4, 1e-4, 0.057),
        (4, 1e-4, 0.08),
        (4, 1e-4, 0.0951),
    ] {
        let options = CardsOptions { edge_radius, pitch, ..CardsOptions::default() };
        let (scene, radius) = (cards(storeys, &options).unwrap(), edge_radius);
        let touches = overlap::pairs(&scene, -TOUCH);
        assert!(touches.iter().all(|pair| pair.depth < TOUCH), "{storeys} storeys: two cards overlap");
        for (i, card) in scene.blocks.iter().enumerate() {
            let near: Vec<&Block> = touches
                .iter()
                .filter(|pair| pair.first == i || pair.second == i)
                .map(|pair| &scene.blocks[if pair.first == i { pair.second } else { pair.first }])
                .collect();
            let is_level = normal(card).z > 0.9;
            let below: Vec<f64> =
                near.iter().filter(|o| o.pos[2] < card.pos[2]).map(|o| o.pos[0] - card.pos[0]).collect();
            if is_level {
                assert!(below.iter().any(|x| *x < 0.0) && below.iter().any(|x| *x > 0.0), "{storeys}: card {i}");
                continue;
            }
            let beside = near.iter().filter(|o| normal(o).z < 0.9).count();
            let on_floor = overlap::lowest_point(card, radius).abs() < TOUCH;
            let on_card = near.iter().any(|o| normal(o).z > 0.9 && o.pos[2] < card.pos[2]);
            assert_eq!((beside, on_floor || on_card), (1, true), "{storeys}: card {i}");
        }
    }
}

#[test]
fn a_house_has_a_mirror_image_where_its_number_of_level_cards_is_odd() {
    let scene = house(4, 1e-4);
    for (left, right) in [(0, 7), (1, 6), (8, 9), (11, 16), (12, 15), (13, 14)] {
        let (left, right) = (&scene.blocks[left], &scene.blocks[right]);
        assert_near(left.pos[0], -right.pos[0]);
        assert_near(left.pos[2], right.pos[2]);
        assert_near(normal(left).x, -normal(right).x);
    }
}

/// From a length of a card on, the level cards lie end to end.
#[test]
fn a_house_of_wide_pitch_is_level() {
    let options = CardsOptions { pitch: 0.0946, ..CardsOptions::default() };
    let radius = options.edge_radius;
    let scene = cards(5, &options).unwrap();
    let storey = height(radius) + CARD[2];
    for card in &scene.blocks {
        let storeys = card.pos[2] / storey;
        if normal(card).z > 0.9 {
            assert_eq!(card.orientation, None);
            assert_near(card.pos[2] + 0.5 * CARD[2], storeys.ceil() * storey);
        } else {
            assert_near(card.pos[2] - 0.5 * height(radius), storeys.floor() * storey);
            assert!((normal(card).z - lean().1).abs() < 1e-12);
        }
    }
    assert!(overlap::pairs(&scene, TOUCH).is_empty());
}

#[test]
fn options_out_of_range_are_rejected() {
    for storeys in [0, MAX_STOREYS + 1] {
        let error = cards(storeys, &CardsOptions::default()).unwrap_err().to_string();
        assert_eq!(error, format!("`storeys` is {storeys}, expected 1 to 30"));
    }
    let error = cards(4, &CardsOptions { edge_radius: 3e-4, ..CardsOptions::default() }).unwrap_err().to_string();
    assert!(error.starts_with("`edge_radius` is 0.0003 m, expected 0 to 0.000233 m"), "{error}");
    for pitch in [0.05, 0.096, f64::NAN] {
        let error = cards(4, &CardsOptions { pitch, ..CardsOptions::default() }).unwrap_err().to_string();
        assert_eq!(error, format!("`pitch` is {pitch}, expected 0.057 to 0.0951 m"));
    }
    let error = cards(4, &CardsOptions { friction: -0.1, ..CardsOptions::default() }).unwrap_err().to_string();
    assert!(error.starts_with("`friction` is -0.1"), "{error}");
}
