//! A device of its own, that counts what lives on it and what it complains of.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::evidence::CaseError;

/// Frames that may be under way.
const FLIGHT: usize = 3;

pub(super) struct Device {
    instance: wgpu::Instance,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    complaints: Arc<AtomicUsize>,
}

impl Device {
    pub(super) fn open() -> Result<Self, CaseError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
        let complaints = Arc::new(AtomicUsize::new(0));
        let counter = Arc::clone(&complaints);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if counter.fetch_add(1, Ordering::Relaxed) < 3 {
                eprintln!("soak_water: {error}");
            }
        }));
        Ok(Self { instance, device, queue, complaints })
    }

    pub(super) fn wait(&self) -> Result<(), CaseError> {
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        Ok(())
    }

    /// Submits, and waits for what was submitted some frames before, as a game's swap chain does.
    pub(super) fn submit(
        &self,
        commands: wgpu::CommandBuffer,
        flight: &mut VecDeque<wgpu::SubmissionIndex>,
    ) -> Result<(), CaseError> {
        flight.push_back(self.queue.submit([commands]));
        if flight.len() > FLIGHT
            && let Some(oldest) = flight.pop_front()
        {
            self.device.poll(wgpu::PollType::Wait { submission_index: Some(oldest), timeout: None })?;
        }
        Ok(())
    }

    pub(super) fn complaints(&self) -> usize {
        self.complaints.load(Ordering::Relaxed)
    }

    /// How many buffers, textures, views, bind groups and pipelines are alive.
    pub(super) fn resources(&self) -> usize {
        let Some(report) = self.instance.generate_report() else { return 0 };
        let hub = report.hub;
        [hub.buffers, hub.textures, hub.texture_views, hub.bind_groups, hub.compute_pipelines, hub.command_buffers]
            .iter()
            .map(|kind| kind.num_allocated)
            .sum()
    }
}
