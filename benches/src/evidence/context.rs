//! What a case is given: how much to do, a device, and the machine's limits.

use std::cell::OnceCell;
use std::path::PathBuf;
use std::sync::Mutex;

use open_water_shaders::pipeline::{Frame, Staging};

use super::{Adapter, CaseError, Effort};

/// A graphics device with WebGPU's default limits and no optional feature.
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// What it is.
    pub adapter: Adapter,
    staging: Mutex<Staging>,
}

impl Gpu {
    fn open() -> Result<Self, String> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|error| format!("no graphics adapter ({error}); `cargo xtask test` sets up a software one"))?;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))
            .map_err(|error| format!("no device: {error}"))?;
        let info = adapter.get_info();
        let adapter = Adapter {
            name: info.name,
            kind: format!("{:?}", info.device_type),
            backend: info.backend.to_string(),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        };
        Ok(Self { staging: Mutex::new(Staging::new(&device)), device, queue, adapter })
    }

    /// Submits what `record` writes and waits until the device has done it.
    pub fn run(&self, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<(), CaseError> {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        record(&mut encoder);
        self.queue.submit([encoder.finish()]);
        self.wait()
    }

    /// As [`Self::run`], with uploads.
    pub fn frame(&self, record: impl FnOnce(&mut Frame<'_>)) -> Result<(), CaseError> {
        let mut staging = self.staging.lock().map_err(|_| "a case panicked")?;
        let mut encoder = self.device.create_command_encoder(&Default::default());
        record(&mut staging.frame(&mut encoder).ok_or("the device is behind")?);
        self.queue.submit([encoder.finish()]);
        self.wait()
    }

    /// Waits until the device is idle.
    pub fn wait(&self) -> Result<(), CaseError> {
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        Ok(())
    }
}

/// Given to every case.
pub struct Context {
    /// Whether the short form is asked for.
    pub quick: bool,
    /// How long to time.
    pub effort: Effort,
    /// Where a case may leave pictures of its own.
    pub out: PathBuf,
    gpu: OnceCell<Result<Gpu, String>>,
}

impl Context {
    /// A context for the quick or the full form.
    pub fn new(quick: bool, out: PathBuf) -> Self {
        let effort = if quick { Effort::QUICK } else { Effort::FULL };
        Self { quick, effort, out, gpu: OnceCell::new() }
    }

    /// The device, opened when first asked for.
    pub fn gpu(&self) -> Result<&Gpu, CaseError> {
        self.gpu.get_or_init(Gpu::open).as_ref().map_err(|why| why.as_str().into())
    }

    /// `quick` in the short form, else `full`.
    pub fn pick<T>(&self, quick: T, full: T) -> T {
        if self.quick { quick } else { full }
    }
}
