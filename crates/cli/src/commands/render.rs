//! `teeter render`: draws a scene or a recorded game as a picture or a film.

mod motion;
mod recorded;
mod view;

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use teeter_game::Record;
use teeter_render::{Camera, Film, FilmError, Format, GIF_FPS, Renderer, Size, View};
use teeter_report::{OutFile, progress};
use teeter_scene::Scene;
use teeter_study::{MAX_CHANGE_TIME, Timeline};

use crate::arguments::{EngineArguments, number};
use crate::error::Error;
use crate::input::{self, Subject};
use crate::output;
use crate::warnings::Warnings;
use motion::{Motion, Simulated, Stepped, Still};

/// Default frame rates of films, 1/s. A GIF file counts in hundredths of a second.
const FPS: f64 = 30.0;
const FPS_OF_GIF: f64 = 20.0;
/// Default duration of a film, s.
const SECONDS: f64 = 5.0;
/// Maximum duration of a film, s.
const MAX_SECONDS: f64 = 3600.0;

/// Arguments of `teeter render`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Render {
    /// File of a scene or of a record, `-` for standard input, or the name of a scene of the list.
    subject: PathBuf,
    /// File for the picture or film. Its extension is .png, .gif or .mp4.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Simulated time of the picture or of the first one of a film, s; at 0 the scene is drawn as
    /// it stands.
    #[arg(long, default_value_t = 0.0, value_parser = number(0.0, MAX_CHANGE_TIME), value_name = "SECONDS")]
    at: f64,
    /// Duration of a film, s [default: 5, and all that is left of a record].
    #[arg(long, value_parser = number(0.02, MAX_SECONDS))]
    seconds: Option<f64>,
    /// Pictures a second of a film, up to 50 for a GIF file [default: 30, and 20 for a GIF file].
    #[arg(long, value_parser = number(1.0, 60.0))]
    fps: Option<f64>,
    /// Width and height, pixels. An MP4 film has even ones, up to 3840x2160.
    #[arg(long, default_value = "1280x720", value_name = "WIDTHxHEIGHT")]
    size: Size,
    /// View: `auto` frames all blocks; else azimuth and elevation of the camera in degrees, then
    /// its distance from the target and the target in metres, all or the first of them.
    #[arg(long, default_value = "auto", allow_hyphen_values = true, value_parser = view::parse, value_name = "AZ,EL[,DIST[,X,Y,Z]]")]
    camera: View,
    #[command(flatten)]
    engine: EngineArguments,
    /// File of hands, forces, drives and gravity, as of `teeter run`, see docs/inputs.md; `-` for
    /// standard input.
    #[arg(long, value_name = "FILE")]
    inputs: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Report on a picture or a film.
#[derive(Debug, Serialize)]
struct Report {
    /// Name of the file.
    file: String,
    /// Width and height, px.
    width: u32,
    height: u32,
    /// Number of pictures.
    pictures: u32,
    /// Simulated time of the first picture and of the last one, s.
    from_s: f64,
    to_s: f64,
    /// Camera: angles, its distance from the target, and the target.
    azimuth_deg: f32,
    elevation_deg: f32,
    distance_m: f32,
    target_m: [f32; 3],
    /// Warnings, which are printed besides.
    warnings: Warnings,
}

/// Pictures of a film, or the only one.
struct Times {
    /// Time of the first one, s.
    from: f64,
    count: u32,
    /// Pictures a second.
    fps: f64,
}

impl Times {
    /// Simulated time of a picture, s.
    fn time(&self, index: u32) -> f64 {
        self.from + f64::from(index) / self.fps
    }

    /// Simulated time of the last picture, s.
    fn end(&self) -> f64 {
        self.time(self.count - 1)
    }
}

impl Render {
    /// Draws the scene or the game and prints a report.
    pub fn run(self) -> Result<(), Error> {
        if self.subject == Path::new("-") && self.inputs.as_ref() == Some(&self.subject) {
            return Err(Error::StdinTwice);
        }
        let name = self.out.display().to_string();
        let format = Format::of(&self.out).ok_or_else(|| Error::PictureFormat { name: name.clone() })?;
        let (scene, record) = self.read()?;
        let times = self.times(format, record.as_deref(), &name)?;
        let film_error = |source| match source {
            FilmError::Write(source) => Error::Write { name: name.clone(), source },
            source => Error::Film { name: name.clone(), source },
        };
        format.check(self.size, times.fps).map_err(film_error)?;
        let timeline = self.inputs.as_deref().map_or(Ok(Timeline::default()), |path| input::inputs(path, &scene))?;
        // Before the simulation, so that a missing folder is reported before minutes of work.
        let file = OutFile::create(&self.out).map_err(|source| Error::Create { name: name.clone(), source })?;
        let mut film = Film::new(format, file, self.size, times.fps).map_err(film_error)?;
        let mut motion = match &record {
            None => self.motion(&scene, timeline, &times)?,
            Some(record) => recorded::motion(record)
                .map_err(|source| Error::Record { name: self.subject.display().to_string(), source })?,
        };
        let renderer = Renderer::new(&scene);
        let mut camera = None;
        let bar = progress(u64::from(times.count), "pictures");
        for index in 0..times.count {
            let poses = motion.poses(times.time(index));
            // A film keeps the camera of its first picture.
            let camera = camera.get_or_insert_with(|| renderer.camera(&self.camera, &poses, self.size));
            film.add(&renderer.draw(&poses, camera, self.size)).map_err(film_error)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        film.finish().and_then(|file| Ok(file.finish()?)).map_err(film_error)?;
        let camera = camera.expect("there is a first picture");
        self.print(&scene, &times, &camera, motion.warnings())
    }

    /// Reads the scene, and the record if it is that of one.
    fn read(&self) -> Result<(Scene, Option<Box<Record>>), Error> {
        match input::record_or_scene(&self.subject)? {
            Subject::Scene(scene) => Ok((self.engine.material.apply(scene), None)),
            Subject::Record(record, name) => {
                let scene = record.scene.clone();
                if self.inputs.is_some() || self.engine.material.apply(scene.clone()) != scene {
                    return Err(Error::RecordOptions { name });
                }
                Ok((scene, Some(record)))
            }
        }
    }

    /// Pictures of a file of a format.
    fn times(&self, format: Format, record: Option<&Record>, name: &str) -> Result<Times, Error> {
        if !format.is_film() {
            return match (self.seconds, self.fps) {
                (None, None) => Ok(Times { from: self.at, count: 1, fps: 1.0 }),
                _ => Err(Error::FilmOptions { name: name.to_owned() }),
            };
        }
        let fps = self.fps.unwrap_or(if format == Format::Gif { FPS_OF_GIF } else { FPS });
        let seconds = record.map_or(SECONDS, |record| (record.seconds() - self.at).min(MAX_SECONDS));
        let count = (self.seconds.unwrap_or(seconds) * fps).round().max(1.0) as u32;
        Ok(Times { from: self.at, count, fps })
    }

    /// Source of the poses: the scene as it stands where no time passes.
    fn motion<'a>(&self, scene: &'a Scene, timeline: Timeline, times: &Times) -> Result<Box<dyn Motion + 'a>, Error> {
        if times.end() == 0.0 {
            return Ok(Box::new(Still::new(scene, &timeline)));
        }
        Ok(Box::new(Stepped::new(Simulated::new(scene, self.engine.params(true), timeline)?)))
    }

    fn print(&self, scene: &Scene, times: &Times, camera: &Camera, warnings: Warnings) -> Result<(), Error> {
        let report = Report {
            file: self.out.display().to_string(),
            width: self.size.width,
            height: self.size.height,
            pictures: times.count,
            from_s: times.from,
            to_s: times.end(),
            azimuth_deg: camera.azimuth.to_degrees(),
            elevation_deg: camera.elevation.to_degrees(),
            distance_m: camera.distance,
            target_m: camera.target.to_array(),
            warnings,
        };
        if self.json {
            return output::json(&report);
        }
        let (file, size, name, from, to) = (&report.file, self.size, &scene.name, report.from_s, report.to_s);
        output::line(&match report.pictures {
            1 => format!("{file}: {size}, {name} at {from:.2} s"),
            count => format!("{file}: {size}, {count} pictures of {name} from {from:.2} s to {to:.2} s"),
        })
    }
}

const _: () = assert!(FPS_OF_GIF <= GIF_FPS, "the default frame rate is one that a GIF film shows");
