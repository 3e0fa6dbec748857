//! House of cards.
//!
//! A storey is a row of A-frames: two cards that lean against each other on their longer edges.
//! Level cards bridge adjacent frames, their length along the row, and the frames of the next
//! storey stand on their middles. Where a card is longer than the frames are apart, every other
//! level card lies on the ends of its neighbours, a thickness higher, as in a house that is built
//! by hand. What stands with one foot on such an end is turned by up to two degrees.
//!
//! All cards lie along y, so the house is a plane figure. Each part is laid on those below it: its
//! angle is the one at which its left and its right support touch together. So nothing overlaps and
//! nothing falls. Where all is level the house is in equilibrium with friction of 0.5. Where cards
//! are turned it comes to rest within 0.4 mm: both cards of a frame bear a level card then, and at
//! the start only one of them touches it.

mod section;

use glam::{DQuat, DVec2};
use serde::{Deserialize, Serialize};

use crate::error::SceneError;
use crate::form::{Form, Springs};
use crate::scene::{Block, Scene, standard_gravity};
use section::Section;

/// Maximum number of storeys.
pub const MAX_STOREYS: u32 = 30;
/// Length, width and thickness of a card, m.
const CARD: [f64; 3] = [0.094, 0.064, 0.0007];
/// Mass of a card, kg.
const MASS: f64 = 0.002;
/// Angle of a leaning card from level, degrees.
const LEAN: f64 = 65.0;
/// Minimum and maximum distance of adjacent frames, m: at less their feet cross, and at more a card
/// does not bridge them.
const PITCH: (f64, f64) = (0.057, 0.0951);
/// Maximum angle of a part from the position in which it stands on level ground, rad.
const MAX_TURN: f64 = 0.1;
/// Difference of two supports, m, that is rounding: a part that stands on them is not turned.
const ROUNDING: f64 = 1e-14;
/// Maximum number of steps in which the angle of a part is found; five suffice.
const MAX_STEPS: usize = 60;

/// Options of a house of cards.
///
/// ```
/// use teeter_scene::{CardsOptions, cards};
///
/// let house = cards(4, &CardsOptions::default())?;
/// assert_eq!(house.blocks.len(), 20 + 6);
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CardsOptions {
    /// Radius of the edges, m, 0 to a third of the thickness.
    pub edge_radius: f64,
    /// Distance of adjacent frames, m, 57 mm to 95.1 mm. From 94 mm on, the length of a card, level
    /// cards lie end to end and all storeys are level.
    pub pitch: f64,
    /// Coefficient of static friction, 0 to 2.
    pub friction: f64,
    /// Normal stiffness of a contact of 26.8 mm by 26.8 mm, N/m.
    pub stiffness: f64,
}

impl Default for CardsOptions {
    fn default() -> Self {
        Self { edge_radius: 1e-4, pitch: 0.07, friction: 0.7, stiffness: 5e5 }
    }
}

/// Builds a house of cards of 94 x 64 x 0.7 mm and 2 g, 65 degrees from level. All touch
/// exactly.
///
/// # Errors
/// When the number of storeys is not 1 to [`MAX_STOREYS`] or an option is out of its range.
pub fn cards(storeys: u32, options: &CardsOptions) -> Result<Scene, SceneError> {
    if !(1..=MAX_STOREYS).contains(&storeys) {
        let expected = format!("1 to {MAX_STOREYS}");
        return Err(SceneError::Field { field: "storeys", value: storeys.to_string(), expected });
    }
    if !(PITCH.0..=PITCH.1).contains(&options.pitch) {
        let expected = format!("{} to {} m", PITCH.0, PITCH.1);
        return Err(SceneError::Field { field: "pitch", value: options.pitch.to_string(), expected });
    }
    let mut scene = Scene {
        name: format!("cards-{storeys}"),
        gravity: standard_gravity(),
        friction: options.friction,
        kinetic_friction: None,
        restitution: 0.0,
        stiffness: options.stiffness,
        edge_radius: options.edge_radius,
        form: Form::default(),
        springs: Springs::default(),
        blocks: vec![Block::new(0, CARD, MASS, [0.0, 0.0, 0.5])],
        label: None,
        margin: None,
        tilt_az: None,
    };
    // The shapes need a radius that leaves a core.
    scene.validate_fields()?;
    scene.blocks.clear();
    let mut house = House { radius: options.edge_radius, pitch: options.pitch, scene };
    let mut deck = Vec::new();
    for frames in (1..=storeys).rev() {
        let frames: Vec<Section> = (0..frames).flat_map(|i| house.frame(house.offset(i, frames), &deck)).collect();
        deck = house.deck(&frames);
    }
    house.scene.validate()?;
    Ok(house.scene)
}

/// House of which the lower part stands.
struct House {
    /// Radius of the edges, m.
    radius: f64,
    /// Distance of adjacent frames, m.
    pitch: f64,
    scene: Scene,
}

impl House {
    /// Position along the row of part `i` of `count`, m.
    fn offset(&self, i: u32, count: u32) -> f64 {
        self.pitch * (f64::from(i) - 0.5 * f64::from(count - 1))
    }

    /// Adds a frame on the deck below, or on the floor if that has no cards.
    fn frame(&mut self, x: f64, deck: &[Section]) -> [Section; 2] {
        let edges = DVec2::new(CARD[1], CARD[2]);
        let [left, right] = [LEAN, -LEAN].map(|degrees| Section::new(edges, self.radius, degrees.to_radians()));
        // The cores are twice the radius apart where the upper edges meet.
        let half = DVec2::new(left.half_width() + self.radius, 0.0);
        let cards = [left.moved(0.0, -half), right.moved(0.0, half)];
        let cards = self.rest(&cards, x, |card, is_left| match deck {
            [] => card.height_on_floor(self.radius),
            _ if is_left == (card.angle > 0.0) => self.height_on(card, deck.iter()),
            _ => f64::NEG_INFINITY,
        });
        cards.iter().for_each(|card| self.add(card, true));
        [cards[0], cards[1]]
    }

    /// Adds the level cards on adjacent frames: first those that lie on frames alone, then those
    /// between them.
    fn deck(&mut self, frames: &[Section]) -> Vec<Section> {
        let count = (frames.len() / 2).saturating_sub(1) as u32;
        let mut deck: Vec<Section> = Vec::new();
        for i in (0..count).step_by(2).chain((1..count).step_by(2)) {
            let x = self.offset(i, count);
            let card = Section::new(DVec2::new(CARD[0], CARD[2]), self.radius, 0.0);
            let card = self.rest(&[card], x, |card, is_left| {
                self.height_on(card, frames.iter().chain(&deck).filter(|below| is_left == (below.centre.x < x)))
            })[0];
            self.add(&card, false);
            deck.push(card);
        }
        deck
    }

    /// Height at which a card rests on some others.
    fn height_on<'a>(&self, card: &Section, below: impl Iterator<Item = &'a Section>) -> f64 {
        below.map(|other| card.height_on(other, self.radius)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Lays a part at `x` (m) so that it touches on both sides. `height` is the displacement along
    /// z that lays one of its cards on what supports the left or the right side.
    fn rest(&self, part: &[Section], x: f64, height: impl Fn(&Section, bool) -> f64) -> Vec<Section> {
        let at = |turn: f64, z: f64| part.iter().map(move |card| card.moved(turn, DVec2::new(x, z)));
        let side = |turn: f64, is_left: bool| {
            at(turn, 0.0).map(|card| height(&card, is_left)).fold(f64::NEG_INFINITY, f64::max)
        };
        // A turn to the left lowers the left side, so that its support has to lift it higher.
        let difference = |turn: f64| side(turn, true) - side(turn, false);
        let turn = root(difference);
        at(turn, side(turn, true).max(side(turn, false))).collect()
    }

    /// Adds a card to the scene, its width in the plane of the sections if it leans.
    fn add(&mut self, section: &Section, leans: bool) {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let across = if leans { DQuat::from_array([0.0, 0.0, half, half]) } else { DQuat::IDENTITY };
        let orientation = (leans || section.angle != 0.0).then(|| (section.rotation() * across).to_array());
        let id = self.scene.blocks.len() as u32;
        let pos = section.position().to_array();
        self.scene.blocks.push(Block { orientation, ..Block::new(id, CARD, MASS, pos) });
    }
}

/// Returns the angle (rad) at which an increasing function is zero, 0 if it is zero there but for
/// rounding. False position, with a halved value at an end that stays (Illinois method).
fn root(function: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = ((-MAX_TURN, function(-MAX_TURN)), (MAX_TURN, function(MAX_TURN)));
    let mut at = 0.0;
    let mut last = 0.0;
    for _ in 0..MAX_STEPS {
        let value = function(at);
        if value.abs() < ROUNDING {
            break;
        }
        let (moved, other) = if value < 0.0 { (&mut low, &mut high) } else { (&mut high, &mut low) };
        *moved = (at, value);
        if last * value > 0.0 {
            other.1 *= 0.5;
        }
        last = value;
        at = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
    }
    at
}
