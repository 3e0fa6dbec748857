//! List of named scenes, shared by the shell, the page, tests and benchmarks.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::error::SceneError;
use crate::form::{Form, Springs};
use crate::overlap;
use crate::preset::BlockPreset;
use crate::random::Random;
use crate::scene::{Block, Scene, default_stiffness, standard_gravity};
use crate::tower::{self, TowerOptions, WOOD_RESTITUTION, tower};

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
    entry("test-3", "(001)-(101)-(001), its third", Some(Unstable), || exact("(001)-(101)-(001)")),
    entry("test-4", "(100)-(010)-(001), its fourth", Some(Unstable), || exact("(100)-(010)-(001)")),
    entry("test-5", "(010)-(010)-(011), its fifth", Some(Stable), || exact("(010)-(010)-(011)")),
    entry("test-6", "(010)-(010)-(011)-(010)-(001), its sixth", Some(Stable), || {
        exact("(010)-(010)-(011)-(010)-(001)")
    }),
    entry("loose", "six full rows with the loose blocks (L00)-(00L)-(00L)-(0L0)-(L0L)-(LLL)", Some(Stable), || {
        valid(tower::loose("(L00)-(00L)-(00L)-(0L0)-(L0L)-(LLL)", &TowerOptions::exact()))
    }),
    entry("block", "one block on the floor", Some(Stable), || stack(1)),
    entry("column", "ten blocks, one upon the other", Some(Stable), || stack(10)),
    entry("field", "five towers of eight rows, too far apart to touch", Some(Stable), || {
        valid(tower::field(5, &TowerOptions { rows: 8, ..TowerOptions::default() }))
    }),
    entry("pile", "forty blocks let fall", None, pile),
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

fn valid(built: Result<Scene, SceneError>) -> Scene {
    built.expect("every scene of the list is valid")
}

fn exact(text: &str) -> Scene {
    valid(tower::config(text, &TowerOptions::exact()))
}

/// Second static test of the dissertation with its top block moved outwards by `out`, m.
///
/// The middle block and the top one balance on the inner edge of the bottom one, 13.7 mm from the
/// axis; their centre of mass is 27.1 / 2 = 13.55 mm from it. The real tower stood because its top
/// block lay slightly further out.
fn test_2(out: f64) -> Scene {
    let mut scene = exact("(001)-(010)-(001)");
    scene.blocks[2].pos[1] += out;
    scene
}

/// Scene of blocks of nominal size with friction 0.4.
fn scene_of(blocks: Vec<Block>) -> Scene {
    Scene {
        name: String::new(),
        gravity: standard_gravity(),
        friction: 0.4,
        kinetic_friction: None,
        restitution: WOOD_RESTITUTION,
        stiffness: default_stiffness(),
        edge_radius: 0.0,
        form: Form::default(),
        springs: Springs::default(),
        blocks,
        label: None,
        margin: None,
        tilt_az: None,
    }
}

fn nominal(id: u32, pos: [f64; 3], yaw: f64) -> Block {
    let preset = BlockPreset::Dissertation;
    Block { yaw, ..Block::new(id, preset.size(), preset.mass(), pos) }
}

/// Stack of `n` blocks, all along x.
fn stack(n: u32) -> Scene {
    let height = BlockPreset::Dissertation.size()[2];
    scene_of((0..n).map(|i| nominal(i, [0.0, 0.0, height * (f64::from(i) + 0.5)], 0.0)).collect())
}

/// Blocks in the air above each other, each turned and offset at random.
fn pile() -> Scene {
    let mut random = Random::new(1);
    let drop = |i: u32| {
        let mut offset = || 0.03 * (2.0 * random.uniform() - 1.0);
        let pos = [offset(), offset(), 0.03 + 0.025 * f64::from(i)];
        nominal(i, pos, std::f64::consts::PI * random.uniform())
    };
    scene_of((0..40).map(drop).collect())
}

/// Maximum apparent penetration of touching blocks, m.
const ROUNDING: f64 = 1e-12;

/// Tower with blocks moved from the lower rows to the top, none of them quite straight.
fn midgame() -> Scene {
    let text = "(111)-(101)-(111)-(110)-(101)-(011)-(111)-(010)-(111)-(101)-(111)-(110)-(101)-(111)-(011)-(111)-(101)-(111)-(111)-(111)-(011)";
    let mut scene = valid(tower::config(text, &TowerOptions { seed: 2, ..TowerOptions::default() }));
    let mut random = Random::new(2);
    for i in 0..scene.blocks.len() {
        let straight = scene.blocks[i].clone();
        let along_x = straight.yaw == 0.0;
        let mut scatter = 1.0;
        loop {
            let (along, across, turn) =
                (random.clipped_normal(2.0), random.clipped_normal(2.0), random.clipped_normal(2.0));
            let (along, across) = (1e-3 * scatter * along, 0.5e-3 * scatter * across);
            let (dx, dy) = if along_x { (along, across) } else { (across, along) };
            let block = &mut scene.blocks[i];
            block.pos = [straight.pos[0] + dx, straight.pos[1] + dy, straight.pos[2]];
            block.yaw = straight.yaw + 0.01 * scatter * turn;
            // Must clear the straight poses of later blocks too, so that theirs remain free.
            let moved = &scene.blocks[i];
            if scene.blocks.iter().all(|other| other.id == moved.id || overlap::depth(other, moved) < ROUNDING) {
                break;
            }
            // Straighten until the gap is wide enough.
            scatter *= 0.9;
        }
    }
    scene
}
