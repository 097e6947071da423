//! A device to test on: software adapter first, default WebGPU limits, every validation error a failure.

use std::cell::RefCell;
use std::sync::{Arc, Mutex, OnceLock};

use open_water_shaders::pipeline::{Frame, Readback, Staging};

/// A device of its own; the test fails when it is dropped after an error that nobody looked at.
pub(crate) struct Context {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    staging: RefCell<Staging>,
    errors: Arc<Mutex<Vec<String>>>,
}

fn adapter() -> &'static wgpu::Adapter {
    static ADAPTER: OnceLock<wgpu::Adapter> = OnceLock::new();
    ADAPTER.get_or_init(|| {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        adapters.retain(|adapter| adapter.get_info().backend != wgpu::Backend::Noop);
        adapters.retain(|adapter| wgpu::Limits::default().check_limits(&adapter.limits()));
        // Software first: the same answers on every machine. Vulkan before GL.
        adapters.sort_by_key(|adapter| {
            let info = adapter.get_info();
            (info.device_type != wgpu::DeviceType::Cpu, info.backend != wgpu::Backend::Vulkan)
        });
        adapters.into_iter().next().expect(
            "no adapter with the default WebGPU limits was found: `cargo xtask test` sets up what the tests need",
        )
    })
}

impl Context {
    /// A fresh device with WebGPU's default limits and no optional features.
    pub(crate) fn new() -> Self {
        Self::with_features(wgpu::Features::empty())
    }

    /// The optional features that there are.
    pub(crate) fn features() -> wgpu::Features {
        adapter().features()
    }

    /// Likewise with optional features (for measurements).
    pub(crate) fn with_features(features: wgpu::Features) -> Self {
        Self::of(adapter(), features, wgpu::Limits::default())
    }

    /// Likewise with these limits, which the adapter has.
    pub(crate) fn with_limits(limits: wgpu::Limits) -> Self {
        Self::of(adapter(), wgpu::Features::empty(), limits)
    }

    /// A device on which nothing finds memory; `None` where wgpu cannot make one.
    pub(crate) fn starved() -> Option<Self> {
        let mut desc = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        desc.memory_budget_thresholds.for_resource_creation = Some(0);
        let name = adapter().get_info().name;
        let adapters = pollster::block_on(wgpu::Instance::new(desc).enumerate_adapters(wgpu::Backends::VULKAN));
        let adapter = adapters.into_iter().find(|adapter| adapter.get_info().name == name)?;
        let context = Self::of(&adapter, wgpu::Features::empty(), wgpu::Limits::default());
        // Drivers that do not tell of their memory have no such threshold.
        context.buffer(&[0u32; 4]);
        (!context.take_errors().is_empty()).then_some(context)
    }

    fn of(adapter: &wgpu::Adapter, features: wgpu::Features, limits: wgpu::Limits) -> Self {
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("test"),
            required_features: features,
            required_limits: limits,
            ..Default::default()
        }))
        .expect("the adapter gives a device with these limits");
        let errors = Arc::new(Mutex::new(Vec::new()));
        let seen = errors.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut seen) = seen.lock() {
                seen.push(error.to_string());
            }
        }));
        Self { staging: RefCell::new(Staging::new(&device)), device, queue, errors }
    }

    /// The errors so far, which count as looked at.
    pub(crate) fn take_errors(&self) -> Vec<String> {
        std::mem::take(&mut *self.errors.lock().expect("no test panics while holding this"))
    }

    /// A storage buffer holding `data`, readable back.
    pub(crate) fn buffer<T: bytemuck::NoUninit>(&self, data: &[T]) -> wgpu::Buffer {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("test data"),
            size: bytes.len().max(16).next_multiple_of(4) as u64,
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::UNIFORM
                | wgpu::BufferUsages::COPY_DST
                | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    /// Encodes by `encode`, submits and waits.
    pub(crate) fn submit(&self, encode: impl FnOnce(&mut wgpu::CommandEncoder)) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encode(&mut encoder);
        self.queue.submit([encoder.finish()]);
        self.wait();
    }

    /// Encodes by `encode` with its uploads, submits and waits.
    pub(crate) fn frame(&self, encode: impl FnOnce(&mut Frame<'_>)) {
        self.submit(|encoder| self.upload(encoder, encode));
    }

    /// Encodes by `encode` with its uploads.
    pub(crate) fn upload(&self, encoder: &mut wgpu::CommandEncoder, encode: impl FnOnce(&mut Frame<'_>)) {
        let mut staging = self.staging.borrow_mut();
        encode(&mut staging.frame(encoder).expect("few frames are under way"));
    }

    /// Waits for everything submitted.
    pub(crate) fn wait(&self) {
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device finishes its work");
    }

    /// The contents of a buffer.
    pub(crate) fn read<T: bytemuck::Pod>(&self, buffer: &wgpu::Buffer) -> Vec<T> {
        let mut ring = Readback::<()>::new(&self.device, "test", buffer.size(), 1);
        self.submit(|encoder| assert!(ring.encode(encoder, buffer, 0, buffer.size(), ())));
        let reading = ring.poll(&self.device).expect("the copy has come after waiting");
        bytemuck::pod_collect_to_vec(reading.bytes)
    }

    /// The texels of one mip level of a texture, all layers, tightly packed.
    pub(crate) fn read_texture<T: bytemuck::Pod>(&self, texture: &wgpu::Texture, mip_level: u32) -> Vec<T> {
        let texel = texture.format().block_copy_size(None).expect("a colour format");
        let width = (texture.width() >> mip_level).max(1);
        let height = (texture.height() >> mip_level).max(1);
        let layers = texture.depth_or_array_layers();
        let pitch = (width * texel).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.buffer(&vec![0u8; (pitch * height * layers) as usize]);
        self.submit(|encoder| {
            encoder.copy_texture_to_buffer(
                wgpu::TexelCopyTextureInfo {
                    texture,
                    mip_level,
                    origin: wgpu::Origin3d::ZERO,
                    aspect: wgpu::TextureAspect::All,
                },
                wgpu::TexelCopyBufferInfo {
                    buffer: &buffer,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(pitch),
                        rows_per_image: Some(height),
                    },
                },
                wgpu::Extent3d { width, height, depth_or_array_layers: layers },
            );
        });
        let bytes: Vec<u8> = self.read(&buffer);
        let rows = bytes.chunks(pitch as usize).take((height * layers) as usize);
        let tight: Vec<u8> = rows.flat_map(|row| &row[..(width * texel) as usize]).copied().collect();
        bytemuck::pod_collect_to_vec(&tight)
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        // Errors of work that is still under way belong to this test.
        let _ = self.device.poll(wgpu::PollType::wait_indefinitely());
        let errors = self.take_errors();
        if !std::thread::panicking() {
            assert!(errors.is_empty(), "the device reported errors:\n{}", errors.join("\n"));
        }
    }
}
