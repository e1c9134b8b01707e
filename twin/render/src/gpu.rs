//! A layer from a Vulkan adapter, without a window.

mod draw;

use crate::{DrawnBy, RenderError};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use wgpu::DeviceType;

/// An opened adapter with its two pipelines.
pub(crate) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    triangles: wgpu::RenderPipeline,
    capsules: wgpu::RenderPipeline,
    /// First thing that went wrong on the device.
    trouble: Arc<Mutex<Option<String>>>,
    about: wgpu::AdapterInfo,
}

/// Vulkan adapters, the preferred one first.
///
/// Vulkan only: probing OpenGL prints to the terminal and its software drivers crash.
fn found() -> Vec<wgpu::Adapter> {
    static INSTANCE: LazyLock<wgpu::Instance> = LazyLock::new(|| {
        let mut wanted = wgpu::InstanceDescriptor::new_without_display_handle();
        wanted.backends = wgpu::Backends::VULKAN;
        wanted.flags = wgpu::InstanceFlags::empty();
        wgpu::Instance::new(wanted)
    });
    let mut adapters = pollster::block_on(INSTANCE.enumerate_adapters(wgpu::Backends::VULKAN));
    adapters.sort_by_key(|a| match a.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Cpu => 3,
        DeviceType::Other => 4,
    });
    adapters
}

/// Adapters by name, for people.
pub(crate) fn names() -> Vec<String> {
    let name = |a: &wgpu::Adapter| {
        let info = a.get_info();
        let kind = match info.device_type {
            DeviceType::DiscreteGpu => "discrete",
            DeviceType::IntegratedGpu => "integrated",
            DeviceType::VirtualGpu => "virtual",
            DeviceType::Cpu => "software",
            DeviceType::Other => "other",
        };
        format!("{} ({kind}, {} {})", info.name, info.driver, info.driver_info)
    };
    catch_unwind(|| found().iter().map(name).collect()).unwrap_or_default()
}

/// Runs `draw`; a panic inside wgpu becomes an error.
///
/// wgpu panics where a driver breaks its contract, and a picture is not worth the report.
pub(crate) fn guarded<T>(draw: impl FnOnce() -> Result<T, RenderError>) -> Result<T, RenderError> {
    catch_unwind(AssertUnwindSafe(draw)).unwrap_or_else(|cause| {
        let text = cause.downcast_ref::<String>().cloned();
        let text = text.or_else(|| cause.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Err(RenderError::Gpu(text.unwrap_or_else(|| "unknown panic".into())))
    })
}

impl Gpu {
    /// Opens the first adapter that gives a device.
    pub(crate) fn open() -> Result<Gpu, RenderError> {
        let mut why = "none found".to_owned();
        for adapter in found() {
            match Gpu::on(&adapter) {
                Ok(gpu) => return Ok(gpu),
                Err(e) => why = format!("{}: {e}", adapter.get_info().name),
            }
        }
        Err(RenderError::NoAdapter(why))
    }

    fn on(adapter: &wgpu::Adapter) -> Result<Gpu, RenderError> {
        let wanted = wgpu::DeviceDescriptor {
            label: Some("twin"),
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&wanted))
            .map_err(|e| RenderError::Gpu(e.to_string()))?;
        let trouble = Arc::new(Mutex::new(None));
        let keep = |slot: &Arc<Mutex<Option<String>>>, text: String| {
            slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(text);
        };
        let slot = Arc::clone(&trouble);
        device.on_uncaptured_error(Arc::new(move |e: wgpu::Error| keep(&slot, e.to_string())));
        let slot = Arc::clone(&trouble);
        device.set_device_lost_callback(move |reason, text| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                keep(&slot, format!("device lost: {text}"));
            }
        });
        let (triangles, capsules) = draw::pipelines(&device);
        let about = adapter.get_info();
        let gpu = Gpu { device, queue, triangles, capsules, trouble, about };
        gpu.well()?;
        Ok(gpu)
    }

    pub(crate) fn drawn_by(&self) -> DrawnBy {
        let driver = format!("{} {}", self.about.driver, self.about.driver_info);
        DrawnBy::Gpu { adapter: self.about.name.clone(), driver: driver.trim().to_owned() }
    }

    /// The first trouble since the device was opened.
    fn well(&self) -> Result<(), RenderError> {
        match self.trouble.lock().unwrap_or_else(PoisonError::into_inner).clone() {
            None => Ok(()),
            Some(text) => Err(RenderError::Gpu(text)),
        }
    }
}
