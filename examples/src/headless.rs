//! The loop without a window: numbered PNGs and a summary.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use open_water::OpenWater;

use crate::camera::Rig;
use crate::capture::{Capture, Writer};
use crate::draw::Painter;
use crate::font;
use crate::options::Setup;
use crate::scene::advance;
use crate::strokes;
use crate::timing::Timing;
use crate::topview::TopView;
use crate::{Helm, Options, Pick, Scene, SceneError};

/// Seconds of the scene between two pictures.
const FRAME: f32 = 1.0 / 30.0;
const DEFAULT_FRAMES: u32 = 300;

/// What draws.
enum Target {
    Gpu { painter: Box<Painter>, capture: Capture },
    Cpu(TopView),
}

/// What the summary tells.
struct Log {
    ticks: Timing,
    frames: Timing,
    plan: String,
}

pub(crate) fn run<S: Scene>(options: &Options, setup: &Setup<S::Assets>) -> Result<(), SceneError> {
    let folder: PathBuf = options.out.clone().unwrap_or_else(|| "out".into());
    let mut writer = Writer::new(&folder)?;
    let frames = options.frames.unwrap_or(DEFAULT_FRAMES);
    let size = options.size();
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let pick = Pick::choose(options.backend, &instance, None)?;
    let water = match &pick {
        Pick::Gpu(gpu) => OpenWater::new(&gpu.device, &gpu.queue, setup.water.clone())?,
        Pick::Cpu => OpenWater::headless(setup.water.clone())?,
    };
    let mut scene = S::new(options, setup, water)?;
    let mut target = match &pick {
        Pick::Gpu(gpu) => Target::Gpu {
            painter: Box::new(Painter::new(gpu, options, &mut scene, Capture::FORMAT, size)?),
            capture: Capture::new(gpu, size),
        },
        Pick::Cpu => Target::Cpu(TopView::new(size)),
    };
    let mut log = Log { ticks: Timing::default(), frames: Timing::default(), plan: String::new() };
    let mut rig = Rig::number(options.view.unwrap_or(S::VIEW));
    let start = Instant::now();
    let bar = ProgressBar::new(u64::from(frames)).with_style(
        ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta} left").unwrap_or(ProgressStyle::default_bar()),
    );
    for _ in 0..frames {
        log.ticks.of(|| advance(&mut scene, FRAME, Helm::default()))?;
        let subject = scene.subject();
        if !(subject.position.is_finite() && subject.orientation.is_finite()) {
            return Err(SceneError::NotFinite("the boat", scene.water().time()));
        }
        let began = Instant::now();
        let strokes = if options.explain { scene.strokes() } else { Vec::new() };
        let mut picture = match (&mut target, &pick) {
            (Target::Gpu { painter, capture }, Pick::Gpu(gpu)) => {
                let camera = rig.look(&scene, size, FRAME);
                scene.seen(&camera);
                let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                let plan = painter.record(gpu, &mut scene, &camera, capture.view(), &mut encoder);
                log.plan = plan.to_string();
                let mut picture = capture.take(gpu, encoder)?;
                strokes::ink(&mut picture, &strokes, strokes::seen(&camera, size));
                picture
            }
            (Target::Cpu(view), _) => view.draw(&mut scene, &strokes),
            (Target::Gpu { .. }, Pick::Cpu) => break,
        };
        if S::LABELLED {
            font::label(&mut picture, &scene.status());
        }
        log.frames.push(began);
        writer.push(picture)?;
        bar.inc(1);
    }
    writer.finish()?;
    bar.finish_and_clear();
    let adapter = match &pick {
        Pick::Gpu(gpu) => gpu.name.clone(),
        Pick::Cpu => "none: CPU, seen from above".into(),
    };
    let text = summary(options, &scene, &log, frames, &adapter, start.elapsed().as_secs_f32());
    let path = folder.join("summary.txt");
    write(&path, &text)?;
    eprintln!("{frames} pictures and {}", path.display());
    Ok(())
}

fn write(path: &Path, text: &str) -> Result<(), SceneError> {
    std::fs::write(path, text).map_err(|source| SceneError::Write { path: path.into(), source })
}

fn summary<S: Scene>(options: &Options, scene: &S, log: &Log, frames: u32, adapter: &str, seconds: f32) -> String {
    let [w, h] = options.size();
    let reports = scene.water().reports();
    let mut rows = vec![
        ("scene", S::NAME.to_string()),
        ("adapter", adapter.to_string()),
        ("preset", format!("{:?}, seed {}, {w}x{h}", options.preset, options.seed).to_lowercase()),
        ("frames", format!("{frames}, {FRAME:.4} s of the scene each")),
        ("simulated", format!("{:.2} s, {} ticks", scene.water().time(), reports.ticks)),
        ("took", format!("{seconds:.1} s")),
        ("simulation a frame", log.ticks.summary()),
        ("drawing a frame", log.frames.summary()),
        ("time dropped", format!("{:.2} s", reports.dropped_secs)),
    ];
    if let Some(ocean) = scene.water().ocean() {
        let sea = format!("Hs {:.2} m, peak period {:.2} s", ocean.significant_height(), ocean.peak_period());
        rows.push(("sea", sea));
    }
    rows.extend(scene.summary());
    let mut text = String::new();
    for (name, value) in rows {
        let _ = writeln!(text, "{name:<20} {value}");
    }
    if !log.plan.is_empty() {
        let _ = writeln!(text, "\nlast frame's plan: {}", log.plan);
    }
    text
}
