//! Arguments that replace properties of a scene.

use clap::Args;
use teeter_scene::{Form, Particles, SPRING_STIFFNESS, STIFFNESS, Scene, Springs, WOOD_SPRINGS};

use super::number::number;

/// Properties that replace those of a scene.
#[derive(Debug, Args)]
pub struct Material {
    /// Stiffness of a contact of 26.8 mm by 26.8 mm, N/m, 1e4 to 1e8 [default: that of the scene,
    /// 1e6 where it has none].
    #[arg(long, value_parser = number(STIFFNESS.0, STIFFNESS.1), value_name = "N/M")]
    stiffness: Option<f64>,
    /// Form of the blocks: rigid, or a lattice of 8 particles and 28 springs each [default: that of
    /// the scene, rigid where it has none].
    #[arg(long)]
    form: Option<Form>,
    /// Stiffness of each spring of a lattice, N/m, 1e3 to 1e8, or `wood`, 3e7 [default: that of the
    /// scene, of the contacts where it has none].
    #[arg(long, value_parser = spring_stiffness, value_name = "N/M")]
    spring_stiffness: Option<f64>,
    /// Positions of the particles: inside, so that a block has the inertia of a solid one, or
    /// corners, as in the dissertation.
    #[arg(long)]
    particles: Option<Particles>,
}

impl Material {
    /// Returns the scene with these properties.
    pub fn apply(&self, scene: Scene) -> Scene {
        let springs = Springs {
            stiffness: self.spring_stiffness.or(scene.springs.stiffness),
            particles: self.particles.unwrap_or(scene.springs.particles),
            ..scene.springs
        };
        Scene {
            stiffness: self.stiffness.unwrap_or(scene.stiffness),
            form: self.form.unwrap_or(scene.form),
            springs,
            ..scene
        }
    }
}

/// Parses a stiffness of springs, or the name of one.
fn spring_stiffness(text: &str) -> Result<f64, String> {
    match text {
        "wood" => Ok(WOOD_SPRINGS),
        _ => number(SPRING_STIFFNESS.0, SPRING_STIFFNESS.1)(text).map_err(|error| format!("{error}, or wood")),
    }
}
