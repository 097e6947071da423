//! Pictures to files: an offscreen target, and a thread that writes PNGs.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use image::RgbaImage;

use crate::{Gpu, SceneError};

/// A colour target that can be read back.
#[derive(Debug)]
pub struct Capture {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    buffer: wgpu::Buffer,
    pitch: u32,
}

impl Capture {
    /// Its format.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

    /// A target of so many pixels.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("capture"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Self::FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let pitch = (4 * size[0]).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("capture"),
            size: u64::from(pitch * size[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view, buffer, pitch }
    }

    /// The target.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Submits the encoder and waits for the picture.
    ///
    /// # Errors
    /// The device is lost, or reported an error.
    pub fn take(&self, gpu: &Gpu, mut encoder: wgpu::CommandEncoder) -> Result<RgbaImage, SceneError> {
        let lost = |error: &dyn std::fmt::Display| SceneError::Gpu(format!("{}: {error}", gpu.name));
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.pitch),
                    rows_per_image: None,
                },
            },
            self.texture.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        self.buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| lost(&e))?;
        gpu.check()?;
        let mapped = self.buffer.get_mapped_range(..).map_err(|e| lost(&e))?;
        let (width, height) = (self.texture.width(), self.texture.height());
        let rows = mapped.chunks(self.pitch as usize).take(height as usize);
        let pixels: Vec<u8> = rows.flat_map(|row| &row[..4 * width as usize]).copied().collect();
        drop(mapped);
        self.buffer.unmap();
        RgbaImage::from_raw(width, height, pixels).ok_or_else(|| lost(&"the picture is cut short"))
    }
}

/// Writes `frame-00000.png` and so on in a thread of its own.
pub(crate) struct Writer {
    sender: Option<SyncSender<RgbaImage>>,
    thread: Option<JoinHandle<Result<(), SceneError>>>,
}

fn write_all(folder: &Path, pictures: &Receiver<RgbaImage>) -> Result<(), SceneError> {
    for (index, picture) in pictures.iter().enumerate() {
        let path = folder.join(format!("frame-{index:05}.png"));
        picture.save(&path).map_err(|error| SceneError::Write { path, source: std::io::Error::other(error) })?;
    }
    Ok(())
}

impl Writer {
    /// Makes the folder.
    pub(crate) fn new(folder: &Path) -> Result<Self, SceneError> {
        std::fs::create_dir_all(folder).map_err(|source| SceneError::Write { path: folder.into(), source })?;
        let folder: PathBuf = folder.into();
        // Two pictures may wait; then the scene does.
        let (sender, pictures) = sync_channel(2);
        let thread = std::thread::spawn(move || write_all(&folder, &pictures));
        Ok(Self { sender: Some(sender), thread: Some(thread) })
    }

    /// Hands a picture over. An error of the thread shows here or in `finish`.
    pub(crate) fn push(&mut self, picture: RgbaImage) -> Result<(), SceneError> {
        let sent = self.sender.as_ref().is_some_and(|sender| sender.send(picture).is_ok());
        if sent { Ok(()) } else { self.finish() }
    }

    /// Waits until all is written.
    pub(crate) fn finish(&mut self) -> Result<(), SceneError> {
        self.sender = None;
        match self.thread.take().map(JoinHandle::join) {
            None => Ok(()),
            Some(Ok(result)) => result,
            Some(Err(_)) => Err(SceneError::Gpu("the thread that writes pictures ended early".into())),
        }
    }
}
