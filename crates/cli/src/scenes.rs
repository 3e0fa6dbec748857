//! `teeter scene`: prints scenes.

use clap::Parser;
use serde::Serialize;
use teeter_scene::{NAMED, Scene, Stability, TowerOptions, config, field, loose, tower};

use crate::args::{Common, Named, SceneArgs, What};
use crate::fault::Fault;
use crate::{input, output};

/// Prints a scene, or the list of those that have names.
pub fn main(args: SceneArgs) -> Result<(), Fault> {
    let scene = match args.what {
        What::List(list) => return print_list(list.json),
        What::Tower(t) => {
            let height_sd = 1e-3 * t.height_sd;
            let options =
                TowerOptions { rows: t.rows, height_sd, mass_sd: t.mass_sd.map(|g| 1e-3 * g), ..options(&t.common) };
            t.common.material.applied(checked(if t.towers == 1 { tower(&options) } else { field(t.towers, &options) })?)
        }
        What::Config(c) => {
            let options =
                TowerOptions { height_sd: 1e-3 * c.height_sd, mass_sd: Some(1e-3 * c.mass_sd), ..options(&c.common) };
            c.common.material.applied(match (&c.config, &c.loose) {
                (Some(text), _) => checked(config(text, &options))?,
                (None, Some(text)) => checked(loose(text, &options))?,
                (None, None) => return Err("a configuration is missing, expected --config or --loose".into()),
            })
        }
        What::Named(words) => {
            let named = Named::try_parse_from(words)?;
            named.material.applied(input::known(&named.name)?)
        }
    };
    output::line(&scene.to_json())
}

fn options(common: &Common) -> TowerOptions {
    TowerOptions {
        seed: common.seed,
        block: common.block,
        friction: common.friction,
        kinetic_friction: common.kinetic_friction,
        restitution: common.restitution,
        ..TowerOptions::default()
    }
}

fn checked(scene: Result<Scene, teeter_scene::SceneError>) -> Result<Scene, Fault> {
    scene.map_err(|e| Fault::Said(e.to_string()))
}

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    title: &'static str,
    expect: Option<Stability>,
}

#[derive(Serialize)]
struct Entries {
    scenes: Vec<Entry>,
}

fn print_list(json: bool) -> Result<(), Fault> {
    if json {
        let scenes = NAMED.iter().map(|n| Entry { name: n.name, title: n.title, expect: n.expect }).collect();
        return output::line(&output::json(&Entries { scenes }));
    }
    let width = NAMED.iter().map(|n| n.name.len()).max().unwrap_or(0);
    for n in NAMED {
        let expect = n.expect.map_or(String::new(), |v| v.to_string());
        output::line(&format!("{:width$}  {expect:8}  {}", n.name, n.title))?;
    }
    Ok(())
}
