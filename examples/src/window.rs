//! The window: steering, cameras, pause, and the overlay with the frame's plan and timings.

use std::sync::Arc;
use std::time::Instant;

use open_water::OpenWater;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::{Window, WindowId};

use crate::camera::{Mode, Rig};
use crate::draw::Painter;
use crate::options::Setup;
use crate::overlay::Overlay;
use crate::scene::advance;
use crate::timing::Timing;
use crate::{Gpu, Helm, Options, Pick, Scene, SceneError};

/// How the window ended.
pub(crate) enum Outcome {
    Done,
    NoDisplay(String),
}

/// What exists once there is a window.
struct Live<S> {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    gpu: Box<Gpu>,
    scene: S,
    painter: Painter,
    overlay: Overlay,
    last: Instant,
    plan: String,
    ticks: Timing,
    records: Timing,
    frames: Timing,
}

/// Keys by which a scene is told a number.
const DIGITS: [KeyCode; 5] = [KeyCode::Digit1, KeyCode::Digit2, KeyCode::Digit3, KeyCode::Digit4, KeyCode::Digit5];

#[derive(Default)]
struct Input {
    keys: Vec<KeyCode>,
    autopilot: bool,
    paused: bool,
    hidden: bool,
    explained: bool,
    dragging: bool,
    /// The digit typed since the last frame.
    chosen: Option<u32>,
    cursor: Option<(f32, f32)>,
}

struct App<'a, S: Scene> {
    options: &'a Options,
    setup: &'a Setup<S::Assets>,
    live: Option<Live<S>>,
    rig: Rig,
    input: Input,
    /// Why the loop ended; `Ok(Some(_))`: there is nothing to draw on in a window.
    end: Result<Option<String>, SceneError>,
}

pub(crate) fn run<S: Scene>(options: &Options, setup: &Setup<S::Assets>) -> Result<Outcome, SceneError> {
    let event_loop = match EventLoop::new() {
        Ok(event_loop) => event_loop,
        // winit's own words name a line of its source, which helps nobody here.
        Err(_) => return Ok(Outcome::NoDisplay("no display found".into())),
    };
    let input = Input { autopilot: true, ..Input::default() };
    let mut app = App::<S> {
        options,
        setup,
        live: None,
        rig: Rig::number(options.view.unwrap_or(S::VIEW)),
        input,
        end: Ok(None),
    };
    event_loop.run_app(&mut app).map_err(|error| SceneError::Gpu(error.to_string()))?;
    Ok(match app.end? {
        Some(why) => Outcome::NoDisplay(why),
        None => Outcome::Done,
    })
}

impl<S: Scene> Live<S> {
    /// `Ok(Err(why))`: no adapter can draw here.
    fn open(
        event_loop: &ActiveEventLoop,
        options: &Options,
        setup: &Setup<S::Assets>,
    ) -> Result<Result<Self, String>, SceneError> {
        let [w, h] = options.size();
        let attributes = Window::default_attributes().with_title(S::NAME).with_inner_size(PhysicalSize::new(w, h));
        let window = match event_loop.create_window(attributes) {
            Ok(window) => Arc::new(window),
            Err(_) => return Ok(Err("the display refuses a window".into())),
        };
        let display = Box::new(event_loop.owned_display_handle());
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle_from_env(display));
        let surface = match instance.create_surface(window.clone()) {
            Ok(surface) => surface,
            Err(error) => return Ok(Err(error.to_string())),
        };
        let Pick::Gpu(gpu) = Pick::choose(options.backend, &instance, Some(&surface))? else {
            return Ok(Err("no adapter draws into a window here".into()));
        };
        let size = window.inner_size();
        let Some(mut config) = surface.get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1)) else {
            return Ok(Err("the adapter cannot draw into this window".into()));
        };
        // The renderer tone-maps for formats of 8 and 10 bits.
        let formats = surface.get_capabilities(&gpu.adapter).formats;
        if let Some(format) = formats.iter().find(|f| f.is_srgb()).or(formats.first()) {
            config.format = *format;
        }
        surface.configure(&gpu.device, &config);
        let water = OpenWater::new(&gpu.device, &gpu.queue, setup.water.clone())?;
        let mut scene = S::new(options, setup, water)?;
        let painter = Painter::new(&gpu, options, &mut scene, config.format, [config.width, config.height])?;
        let overlay = Overlay::new(&gpu, config.format);
        Ok(Ok(Self {
            window,
            surface,
            config,
            gpu,
            scene,
            painter,
            overlay,
            last: Instant::now(),
            plan: String::new(),
            ticks: Timing::default(),
            records: Timing::default(),
            frames: Timing::default(),
        }))
    }

    fn resize(&mut self, size: PhysicalSize<u32>) {
        if size.width > 0 && size.height > 0 {
            (self.config.width, self.config.height) = (size.width, size.height);
            self.surface.configure(&self.gpu.device, &self.config);
            self.painter.resize(&self.gpu, [size.width, size.height]);
        }
    }

    fn frame(&mut self, rig: &mut Rig, input: &mut Input) -> Result<(), SceneError> {
        use wgpu::CurrentSurfaceTexture as Current;
        if let Some(number) = input.chosen.take() {
            self.scene.choose(number)?;
        }
        let dt = self.last.elapsed().as_secs_f32();
        self.frames.push(self.last);
        self.last = Instant::now();
        let helm = Helm { manual: (!input.autopilot).then(|| input.helm()) };
        let water_dt = if input.paused { 0.0 } else { dt };
        self.ticks.of(|| advance(&mut self.scene, water_dt, helm))?;
        let (Current::Success(texture) | Current::Suboptimal(texture)) = self.surface.get_current_texture() else {
            self.surface.configure(&self.gpu.device, &self.config);
            return Ok(());
        };
        let start = Instant::now();
        let view = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let size = self.painter.size();
        let camera = rig.look(&self.scene, size, dt.min(0.1));
        self.scene.seen(&camera);
        let plan = self.painter.record(&self.gpu, &mut self.scene, &camera, &view, &mut encoder);
        self.plan = plan.to_string();
        let text = if input.hidden {
            String::new()
        } else {
            format!(
                "frame {:.1} ms, ticks {:.2} ms, record {:.2} ms\n{}\n\n{}",
                self.frames.recent(),
                self.ticks.recent(),
                self.records.recent(),
                self.scene.status(),
                self.plan
            )
        };
        let strokes = if input.explained { self.scene.strokes() } else { Vec::new() };
        if !text.is_empty() || !strokes.is_empty() {
            self.overlay.draw(&self.gpu, &text, (&strokes, &camera), size, &view, &mut encoder);
        }
        self.gpu.queue.submit([encoder.finish()]);
        self.window.pre_present_notify();
        self.gpu.queue.present(texture);
        self.records.push(start);
        self.gpu.check()
    }
}

impl Input {
    fn helm(&self) -> [f32; 2] {
        use KeyCode as K;
        let held = |a, b| f32::from(u8::from(self.keys.contains(&a) || self.keys.contains(&b)));
        [
            held(K::KeyW, K::ArrowUp) - held(K::KeyS, K::ArrowDown),
            held(K::KeyD, K::ArrowRight) - held(K::KeyA, K::ArrowLeft),
        ]
    }

    fn key<S: Scene>(&mut self, code: KeyCode, event: &KeyEvent, rig: &mut Rig) {
        use KeyCode as K;
        self.keys.retain(|k| *k != code);
        if event.state != ElementState::Pressed {
            return;
        }
        self.keys.push(code);
        let steers = [K::KeyW, K::KeyA, K::KeyS, K::KeyD, K::ArrowUp, K::ArrowLeft, K::ArrowDown, K::ArrowRight];
        if steers.contains(&code) {
            self.autopilot = false;
        }
        match code {
            _ if event.repeat => {}
            K::KeyP => self.autopilot = !self.autopilot,
            K::Space => self.paused = !self.paused,
            K::KeyO => self.hidden = !self.hidden,
            K::KeyE => self.explained = !self.explained,
            K::KeyC => rig.next::<S>(),
            _ => self.chosen = DIGITS.iter().position(|digit| *digit == code).map(|at| at as u32 + 1),
        }
    }
}

impl<S: Scene> ApplicationHandler for App<'_, S> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.live.is_some() {
            return;
        }
        match Live::open(event_loop, self.options, self.setup) {
            Ok(Ok(live)) => self.live = Some(live),
            Ok(Err(why)) => self.end = Ok(Some(why)),
            Err(error) => self.end = Err(error),
        }
        match &self.live {
            Some(live) => live.window.request_redraw(),
            None => event_loop.exit(),
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(live) = &mut self.live else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => live.resize(size),
            WindowEvent::KeyboardInput { event, .. } => match event.physical_key {
                PhysicalKey::Code(KeyCode::Escape) => event_loop.exit(),
                PhysicalKey::Code(code) => self.input.key::<S>(code, &event, &mut self.rig),
                PhysicalKey::Unidentified(_) => {}
            },
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => {
                self.input.dragging = state == ElementState::Pressed;
            }
            WindowEvent::CursorMoved { position, .. } => {
                let now = (position.x as f32, position.y as f32);
                if let Some(before) = self.input.cursor.replace(now).filter(|_| self.input.dragging) {
                    self.rig.mode = Mode::Orbit;
                    self.rig.drag(now.0 - before.0, now.1 - before.1);
                }
            }
            WindowEvent::MouseWheel { delta, .. } => self.rig.wheel(match delta {
                MouseScrollDelta::LineDelta(_, y) => -y,
                MouseScrollDelta::PixelDelta(p) => -p.y as f32 / 40.0,
            }),
            WindowEvent::RedrawRequested => {
                if let Err(error) = live.frame(&mut self.rig, &mut self.input) {
                    self.end = Err(error);
                    event_loop.exit();
                }
                live.window.request_redraw();
            }
            _ => {}
        }
    }
}
