//! A device of wgpu's `noop` backend, on which every validation error is a failure.

use std::sync::{Arc, Mutex};

/// A device that checks what it is told, copies buffers and does nothing else.
pub(crate) struct Device {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    errors: Arc<Mutex<Vec<String>>>,
}

impl Device {
    pub(crate) fn new() -> Self {
        Self::with(wgpu::Features::empty(), wgpu::Limits::default())
    }

    pub(crate) fn with(features: wgpu::Features, limits: wgpu::Limits) -> Self {
        let mut desc = wgpu::InstanceDescriptor::new_without_display_handle();
        desc.backends = wgpu::Backends::NOOP;
        desc.backend_options.noop = wgpu::NoopBackendOptions::enabled();
        let adapters = wgpu::Instance::new(desc).enumerate_adapters(wgpu::Backends::NOOP);
        let adapter = pollster::block_on(adapters).into_iter().next().expect("wgpu has its noop backend");
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_features: features,
            required_limits: limits,
            ..Default::default()
        }))
        .expect("it gives any device");
        let errors = Arc::new(Mutex::new(Vec::new()));
        let seen = errors.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut seen) = seen.lock() {
                seen.push(error.to_string());
            }
        }));
        Self { device, queue, errors }
    }

    pub(crate) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&Default::default())
    }

    pub(crate) fn submit(&self, encoders: impl IntoIterator<Item = wgpu::CommandEncoder>) {
        self.queue.submit(encoders.into_iter().map(wgpu::CommandEncoder::finish));
        let _ = self.device.poll(wgpu::PollType::Poll);
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let errors = self.errors.lock().expect("no test panics while holding this");
            assert!(errors.is_empty(), "the device reported errors:\n{}", errors.join("\n"));
        }
    }
}
