//! Which adapter draws.

use std::sync::{Arc, Mutex};

use open_water::OpenWater;

use crate::{Backend, SceneError};

/// A device and what the scene needs to know of it.
#[derive(Debug)]
pub struct Gpu {
    /// The adapter.
    pub adapter: wgpu::Adapter,
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// What is said of it: name, API, whether it is software.
    pub name: String,
    /// Whether the processor stands in for a GPU.
    pub software: bool,
    errors: Arc<Mutex<Vec<String>>>,
}

/// What was found.
#[derive(Debug)]
pub enum Pick {
    /// An adapter with a device.
    Gpu(Box<Gpu>),
    /// Nothing that draws.
    Cpu,
}

fn rank(adapter: &wgpu::Adapter) -> u32 {
    match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

fn adapters(instance: &wgpu::Instance, surface: Option<&wgpu::Surface<'_>>) -> Vec<wgpu::Adapter> {
    let fits = |adapter: &wgpu::Adapter| {
        adapter.get_info().backend != wgpu::Backend::Noop
            && OpenWater::required_limits().check_limits(&adapter.limits())
            && surface.is_none_or(|surface| adapter.is_surface_supported(surface))
    };
    // The older APIs are asked only when the newer ones have nothing: asking them can be slow and noisy.
    for backends in [wgpu::Backends::PRIMARY, wgpu::Backends::SECONDARY] {
        let mut found = pollster::block_on(instance.enumerate_adapters(backends));
        found.retain(fits);
        found.sort_by_key(rank);
        if !found.is_empty() {
            return found;
        }
    }
    Vec::new()
}

impl Pick {
    /// Takes the best adapter that `backend` allows, and says so on stderr.
    ///
    /// # Errors
    /// `Backend::Gpu` without an adapter, or an adapter that gives no device.
    pub fn choose(
        backend: Backend,
        instance: &wgpu::Instance,
        surface: Option<&wgpu::Surface<'_>>,
    ) -> Result<Self, SceneError> {
        if backend == Backend::Cpu {
            eprintln!("computing and drawing on the CPU, as asked");
            return Ok(Self::Cpu);
        }
        let Some(adapter) = adapters(instance, surface).into_iter().next() else {
            if backend == Backend::Gpu {
                return Err(SceneError::Gpu(
                    "no adapter found; --backend cpu needs none, and on Debian or Ubuntu \
                     `apt-get install mesa-vulkan-drivers` brings a software one"
                        .into(),
                ));
            }
            eprintln!("no adapter found: computing and drawing on the CPU, from above");
            return Ok(Self::Cpu);
        };
        let gpu = Gpu::open(adapter)?;
        eprintln!("drawing on {}", gpu.name);
        Ok(Self::Gpu(Box::new(gpu)))
    }
}

impl Gpu {
    fn open(adapter: wgpu::Adapter) -> Result<Self, SceneError> {
        let info = adapter.get_info();
        let software = info.device_type == wgpu::DeviceType::Cpu;
        let kind = if software { ", software" } else { "" };
        let name = format!("{} ({}{kind})", info.name, info.backend);
        let limits = OpenWater::required_limits().using_resolution(adapter.limits());
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("scene"),
            required_limits: limits,
            ..wgpu::DeviceDescriptor::default()
        }))
        .map_err(|error| SceneError::Gpu(format!("{name}: {error}")))?;
        let errors = Arc::new(Mutex::new(Vec::new()));
        let sink = errors.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut list) = sink.lock() {
                list.push(error.to_string());
            }
        }));
        Ok(Self { adapter, device, queue, name, software, errors })
    }

    /// Fails if the device has reported an error since the last call.
    ///
    /// # Errors
    /// The first error, and how many there were.
    pub fn check(&self) -> Result<(), SceneError> {
        let list = self.errors.lock().map(|mut list| std::mem::take(&mut *list)).unwrap_or_default();
        match list.first() {
            None => Ok(()),
            Some(first) => Err(SceneError::Gpu(format!("{} GPU error(s), the first: {first}", list.len()))),
        }
    }
}
