//! List of named scenes, shared by the shell, the page, tests and benchmarks.

mod balance;
mod piles;
mod rows;
mod setting;
mod towers;

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::cards::{CardsOptions, cards};
use crate::preset::BlockPreset;
use crate::scene::Scene;
use crate::tower::{self, TowerOptions, tower};
use balance::{arch, lire, see_saw, slope};
use piles::{pile, stack};
use rows::{dominoes, wall};
use towers::{exact, midgame, test_2, valid};

/// Exact answer for a tower of rigid blocks.
///
/// ```
/// use teeter_scene::{NAMED, Stability};
///
/// let test_2 = NAMED.iter().find(|scene| scene.name == "test-2").expect("the list has it");
/// assert_eq!(test_2.expect, Some(Stability::Unstable));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stability {
    /// The tower stands.
    Stable,
    /// The tower falls.
    Unstable,
}

impl fmt::Display for Stability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Stability::Stable => "stable",
            Stability::Unstable => "unstable",
        })
    }
}

/// Entry of the list of scenes.
///
/// ```
/// for entry in teeter_scene::NAMED {
///     assert_eq!(entry.scene().name, entry.name);
/// }
/// ```
#[derive(Debug, Clone, Copy)]
pub struct NamedScene {
    /// Name of the scene.
    pub name: &'static str,
    /// Title: one line for the reader of the list.
    pub title: &'static str,
    /// Exact answer for rigid blocks, where there is one.
    pub expect: Option<Stability>,
    /// Builder of the scene without its name and label.
    build: fn() -> Scene,
}

impl NamedScene {
    /// Builds the scene.
    pub fn scene(&self) -> Scene {
        Scene { name: self.name.to_owned(), label: self.expect.map(|v| v.to_string()), ..(self.build)() }
    }
}

use Stability::{Stable, Unstable};

const fn entry(name: &'static str, title: &'static str, expect: Option<Stability>, build: fn() -> Scene) -> NamedScene {
    NamedScene { name, title, expect, build }
}

/// Named scenes.
pub const NAMED: &[NamedScene] = &[
    entry("tower", "the tower of 18 rows that a game begins with", Some(Stable), || {
        valid(tower(&TowerOptions::default()))
    }),
    entry("official", "the same in blocks of 75 x 25 x 15 mm", Some(Stable), || {
        valid(tower(&TowerOptions { block: BlockPreset::Official, ..TowerOptions::default() }))
    }),
    entry("midgame", "a tower in the middle of a game, put together by hand", Some(Stable), midgame),
    entry("test-1", "(010)-(010)-(010)-(010)-(010)-(010), the dissertation's first static test", Some(Stable), || {
        exact("(010)-(010)-(010)-(010)-(010)-(010)")
    }),
    entry("test-2", "(001)-(010)-(001), its second: short of balance by 0.15 mm", Some(Unstable), || test_2(0.0)),
    entry(
        "test-2-in",
        "the second with the top block 1 mm further in: short of balance by 0.65 mm",
        Some(Unstable),
        || test_2(-1e-3),
    ),
    entry(
        "test-2-out",
        "the second with the top block 1 mm further out: balanced, 0.35 mm to spare",
        Some(Stable),
        || test_2(1e-3),
    ),
    entry("test-2-taken", "(001)-(010), the second once its top block is taken away", Some(Unstable), || {
        exact("(001)-(010)")
    }),
    entry("test-3", "(001)-(101)-(001), its third", Some(Unstable), || exact("(001)-(101)-(001)")),
    entry("test-4", "(100)-(010)-(001), its fourth", Some(Unstable), || exact("(100)-(010)-(001)")),
    entry("test-5", "(010)-(010)-(011), its fifth", Some(Stable), || exact("(010)-(010)-(011)")),
    entry("test-6", "(010)-(010)-(011)-(010)-(001), its sixth", Some(Stable), || {
        exact("(010)-(010)-(011)-(010)-(001)")
    }),
    entry("loose", "six full rows with the loose blocks (L00)-(00L)-(00L)-(0L0)-(L0L)-(LLL)", Some(Stable), || {
        valid(tower::loose("(L00)-(00L)-(00L)-(0L0)-(L0L)-(LLL)", &TowerOptions::exact()))
    }),
    entry(
        "moves",
        "the same six rows with 2-1 loose too, as its step 9 says: (L00)-(L0L)-(00L)-(0L0)-(L0L)-(LLL)",
        Some(Stable),
        || valid(tower::loose("(L00)-(L0L)-(00L)-(0L0)-(L0L)-(LLL)", &TowerOptions::exact())),
    ),
    entry("block", "one block on the floor", Some(Stable), || stack(1)),
    entry("column", "ten blocks, one upon the other", Some(Stable), || stack(10)),
    entry("field", "five towers of eight rows, too far apart to touch", Some(Stable), || {
        valid(tower::field(5, &TowerOptions { rows: 8, ..TowerOptions::default() }))
    }),
    entry("pile", "forty blocks let fall", None, pile),
    entry("cards", "a house of cards: four storeys, 26 cards", Some(Stable), || {
        valid(cards(4, &CardsOptions::default()))
    }),
    entry("dominoes", "a row of twenty dominoes, the first of them beyond its balance", Some(Unstable), dominoes),
    entry("lire", "the leaning tower of Lire: ten blocks, the top one wholly beyond the base", Some(Stable), lire),
    entry("arch", "a corbelled arch: two stacks that lean towards each other under one block", Some(Stable), arch),
    entry("wall", "a dry wall of bricks in running bond", Some(Stable), wall),
    entry("see-saw", "a plank on a ridge: one block balances two at half the distance", Some(Stable), see_saw),
    entry("slope", "a tower on a plate that slopes by 15 degrees, below the angle of friction", Some(Stable), slope),
];

/// Returns the scene of the list with this name.
///
/// ```
/// assert_eq!(teeter_scene::named("tower").map(|scene| scene.blocks.len()), Some(54));
/// assert_eq!(teeter_scene::named("castle"), None);
/// ```
pub fn named(name: &str) -> Option<Scene> {
    NAMED.iter().find(|n| n.name == name).map(NamedScene::scene)
}
