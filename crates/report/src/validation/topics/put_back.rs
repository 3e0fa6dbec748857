//! Loose blocks drawn some distance out by the hand, and pushed in again.

use std::slice;

use serde_json::{Value, json};
use teeter_physics::{BodyId, World};
use teeter_scene::{Form, Scene, TowerOptions};
use teeter_study::{PutBack, PutBackOptions, par_map, put_back, settled, xray};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::output::progress;
use crate::statistics::{max, percent, quantile};
use crate::validation::section::Section;
use crate::validation::size::{Size, params};

/// Distances by which a block is drawn out, m.
const DISTANCES: [f64; 4] = [0.01, 0.02, 0.04, 0.06];
/// Maximum number of loose blocks of a tower.
const MAX_BLOCKS: usize = 8;
/// Maximum number of put-backs listed.
const MAX_LISTED: usize = 100;
/// Distance from where it was up to which a block is back, mm: a seventh of its height.
const HOME: f64 = 2.5;
/// Name of the setting without rounded edges.
const SHARP: &str = "sharp edges";
/// Towers of each setting but the first.
const OTHER_TOWERS: u64 = 5;
/// Towers of lattice blocks, which take six times as long.
const LATTICE_TOWERS: u64 = 3;

/// Towers of one kind.
struct Setting {
    name: &'static str,
    /// Contact stiffness, N/m.
    stiffness: f64,
    /// Standard deviation of the heights, m.
    height_sd: f64,
    form: Form,
    /// Radius of the edges, m; that of a default tower where absent.
    edge_radius: Option<f64>,
    towers: u64,
}

impl Setting {
    /// Settings of a report: the default tower, and one change at a time.
    fn all(size: &Size) -> Vec<Self> {
        let few = size.towers.min(OTHER_TOWERS);
        let default = |name, towers| Self {
            name,
            stiffness: 1e6,
            height_sd: TowerOptions::default().height_sd,
            form: size.form,
            edge_radius: None,
            towers,
        };
        let mut settings = vec![default("default", size.towers)];
        if size.quick {
            return settings;
        }
        settings.extend([
            Self { stiffness: 3e6, ..default("3e6 N/m", few) },
            Self { height_sd: 3e-5, ..default("scatter 0.03 mm", few) },
            Self { height_sd: 3e-4, ..default("scatter 0.3 mm", few) },
            Self { edge_radius: Some(0.0), ..default(SHARP, few) },
        ]);
        if size.form == Form::Rigid {
            settings.push(Self { form: Form::Lattice, ..default("lattice", few.min(LATTICE_TOWERS)) });
        }
        settings
    }

    /// Settled towers, each with some of its loose blocks.
    fn worlds(&self, size: &Size) -> Result<Vec<(World, Vec<BodyId>)>, Error> {
        let options = TowerOptions { height_sd: self.height_sd, ..size.tower_options() };
        let scenes = size.towers(self.towers, self.stiffness, &options);
        let worlds = par_map(&scenes, |scene| {
            let edge_radius = self.edge_radius.unwrap_or(scene.edge_radius);
            let scene = Scene { form: self.form, edge_radius, ..scene.clone() };
            let world = settled(&scene, params())?;
            let loose = loose_blocks(&world, if size.quick { 2 } else { MAX_BLOCKS });
            Ok((world, loose))
        });
        worlds.into_iter().collect()
    }
}

/// Loose blocks below the top row, at most `count`, evenly from all.
fn loose_blocks(world: &World, count: usize) -> Vec<BodyId> {
    let loads = xray(world, world.scene().friction);
    let below_top = world.bodies().take(world.len().saturating_sub(3));
    let loose: Vec<BodyId> = below_top.filter(|body| loads[body.index()].is_loose()).collect();
    let count = count.min(loose.len());
    (0..count).map(|i| loose[i * loose.len() / count]).collect()
}

/// Outcomes of a setting at one distance.
struct Outcomes {
    setting: &'static str,
    /// Distance, m.
    distance: f64,
    /// Tower and block of each outcome.
    blocks: Vec<String>,
    backs: Vec<PutBack>,
}

impl Outcomes {
    fn count(&self, is_so: impl Fn(&PutBack) -> bool) -> usize {
        self.backs.iter().filter(|back| is_so(back)).count()
    }

    fn moved(&self, of: fn(&PutBack) -> usize) -> f64 {
        percent(&self.backs, |back| of(back) > 0)
    }

    fn worst(&self) -> f64 {
        max(&self.backs.iter().map(|back| back.worst_mm).collect::<Vec<_>>())
    }

    /// Rows of the put-backs that moved another block.
    fn moved_rows(&self) -> impl Iterator<Item = Vec<String>> {
        let moved = self.backs.iter().zip(&self.blocks).filter(|(back, _)| back.moved_1_mm > 0);
        moved.map(|(back, block)| {
            let (mm, worst) = (format!("{:.0}", 1e3 * self.distance), format!("{:.2}", back.worst_mm));
            vec![self.setting.to_owned(), block.clone(), mm, back.moved_1_mm.to_string(), worst]
        })
    }

    fn data(&self) -> Value {
        let back = |(block, back): (&String, &PutBack)| json!({"block": block, "seen": back});
        let backs: Vec<Value> = self.blocks.iter().zip(&self.backs).map(back).collect();
        json!({"setting": self.setting, "distance_m": self.distance, "put_back": backs})
    }

    fn row(&self) -> Vec<String> {
        let force: Vec<f64> = self.backs.iter().map(|back| back.force_n).collect();
        let aside: Vec<f64> = self.backs.iter().map(|back| back.aside_mm).collect();
        vec![
            self.setting.to_owned(),
            format!("{:.0}", 1e3 * self.distance),
            self.backs.len().to_string(),
            format!("{:.1} %", self.moved(|back| back.moved_1_mm)),
            format!("{:.1} %", self.moved(|back| back.moved_5_mm)),
            format!("{:.1} %", self.moved(|back| back.fell)),
            format!("{:.3}", self.worst()),
            format!("{:.3}", quantile(&force, 0.5)),
            format!("{:.2}, {:.2}", quantile(&aside, 0.5), max(&aside)),
        ]
    }
}

/// Draws loose blocks out and pushes them in again.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "put-back",
        "Loose blocks drawn out and put back",
        "Loose blocks of settled towers (k = 1e6 N/m) are drawn out by the hand of the game along \
         their length at 5 cm/s, and pushed back in to where they were. A second later the other \
         blocks are compared with where they were. The hand holds the end of the block with at \
         most 4 N. Each setting changes one constant of the default tower.",
    );
    let options = PutBackOptions::default();
    let settings = Setting::all(size);
    let worlds: Vec<_> = settings.iter().map(|setting| setting.worlds(size)).collect::<Result<_, _>>()?;
    let pulls: usize = worlds.iter().flatten().map(|(_, loose)| loose.len() * DISTANCES.len()).sum();
    let bar = progress(pulls as u64, "put-backs");
    let mut all = Vec::new();
    for (setting, worlds) in settings.iter().zip(&worlds) {
        let cases: Vec<(&World, BodyId)> =
            worlds.iter().flat_map(|(world, loose)| loose.iter().map(move |body| (world, *body))).collect();
        for distance in DISTANCES {
            let backs = par_map(&cases, |&(world, body)| {
                let back = put_back(world, body, distance, &options);
                bar.inc(1);
                back
            });
            let name = |&(world, body): &(&World, BodyId)| format!("{}, block {body}", world.scene().name);
            let blocks = cases.iter().map(name).collect();
            all.push(Outcomes { setting: setting.name, distance, blocks, backs });
        }
    }
    bar.finish_and_clear();
    figures(&mut section, &all);
    let head = ["setting", "drawn mm", "pulls", "others > 1 mm", "> 5 mm", "fell", "worst mm"];
    let head = [&head[..], &["force inwards N", "block aside mm: median, largest"]].concat();
    section.table(&head, all.iter().map(Outcomes::row).collect());
    let moved = all.iter().flat_map(Outcomes::moved_rows).take(MAX_LISTED).collect();
    section.table(&["setting", "tower and block", "drawn mm", "others > 1 mm", "worst mm"], moved);
    section.charts.push(chart(&all));
    section.data = all.iter().map(Outcomes::data).collect();
    Ok(section)
}

/// Figures with a goal, of the default tower at each distance and of the other settings at all
/// distances together. Sharp edges have no goal: they only show what rounded ones are for.
fn figures(section: &mut Section, all: &[Outcomes]) {
    let (default, others) = all.split_at(DISTANCES.len());
    for of in default {
        goal(section, &format!("drawn {:.0} mm and put back", 1e3 * of.distance), slice::from_ref(of));
    }
    numbers(section, "", default);
    for outcomes in others.chunks(DISTANCES.len()) {
        let setting = outcomes[0].setting;
        if setting != SHARP {
            goal(section, &format!("drawn and put back, {setting}"), outcomes);
        }
        numbers(section, &format!("{}.", setting.replace(' ', "_")), outcomes);
    }
}

fn goal(section: &mut Section, what: &str, outcomes: &[Outcomes]) {
    let tries: usize = outcomes.iter().map(|of| of.backs.len()).sum();
    let share = |is_so: fn(&PutBack) -> bool| {
        100.0 * outcomes.iter().map(|of| of.count(is_so)).sum::<usize>() as f64 / tries.max(1) as f64
    };
    let (moved, displaced) = (share(|back| back.moved_1_mm > 0), share(|back| back.moved_5_mm > 0));
    let worst = max(&outcomes.iter().map(Outcomes::worst).collect::<Vec<_>>());
    section.goal(
        format!("{what}: another block moves by more than 1 mm, 5 mm"),
        format!("{moved:.1} % and {displaced:.1} % of {tries}, {worst:.2} mm at most"),
        "1 %, none",
        moved <= 1.0 && displaced == 0.0,
    );
}

/// Numbers of a setting, all distances together.
fn numbers(section: &mut Section, prefix: &str, outcomes: &[Outcomes]) {
    let mut add = |name: &str, value: f64| section.number(format!("{prefix}{name}"), value);
    let sum = |is_so: fn(&PutBack) -> bool| outcomes.iter().map(|of| of.count(is_so)).sum::<usize>() as f64;
    add("tries", sum(|_| true));
    add("over_1mm", sum(|back| back.moved_1_mm > 0));
    add("over_5mm", sum(|back| back.moved_5_mm > 0));
    add("fell", sum(|back| back.fell > 0));
    add("worst_mm", max(&outcomes.iter().map(Outcomes::worst).collect::<Vec<_>>()));
    add("not_home", sum(|back| !back.out || back.aside_mm > HOME));
}

fn chart(all: &[Outcomes]) -> Chart {
    let line = |outcomes: &[Outcomes]| {
        let points = outcomes.iter().map(|of| (1e3 * of.distance, of.moved(|back| back.moved_1_mm)));
        Series::line(outcomes[0].setting, points.collect())
    };
    Chart {
        title: "Put-backs that move another block by more than 1 mm".into(),
        x: Axis::new("drawn out, mm"),
        y: Axis::new("%"),
        series: all.chunks(DISTANCES.len()).map(line).collect(),
        ..Chart::default()
    }
}
