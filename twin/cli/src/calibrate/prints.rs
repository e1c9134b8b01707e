//! Measured prints of a file, in SI.

use sim::calibration::{Measured, Print};
use sim::cell::Cell;
use sim::process::bead::flow_m3_s;
use sim::process::{Air, Ends, Fidelity, StrandInput};
use slam::measured_file::MeasuredFile;

/// The prints, kind by kind in the order of the file.
pub(super) fn measured(file: &MeasuredFile, cell: &Cell) -> Vec<Measured> {
    let mut prints = Vec::new();
    let mut add = |print, value_mm: f64, sd_mm: f64| {
        prints.push(Measured { print, value_m: value_mm / 1e3, deviation_m: sd_mm / 1e3 });
    };
    for it in &file.free_hang {
        let nozzle_diameter_m = cell.tool.orifice_m;
        add(Print::FreeHang { nozzle_diameter_m }, it.diameter_mm, it.sd_mm);
    }
    for it in &file.bridge {
        let told = (it.speed_mm_s, it.diameter_mm, it.flow_mm3_s);
        add(Print::Bridge(strand(file, cell, it.span_mm, told)), it.sag_mm, it.sd_mm);
    }
    for it in &file.cantilever {
        let told = (it.speed_mm_s, it.diameter_mm, it.flow_mm3_s);
        let strand = StrandInput { dwell_s: it.dwell_s, ..strand(file, cell, it.length_mm, told) };
        add(Print::Cantilever(strand), it.end_miss_mm, it.sd_mm);
    }
    for it in &file.cured_depth {
        // 1 mJ/cm² is 10 J/m².
        add(Print::CuredDepth { dose_j_m2: 10.0 * it.dose_mj_cm2 }, it.depth_mm, it.sd_mm);
    }
    prints
}

/// A strand as the cell usually prints it, in the air of the file.
pub(super) fn usual(file: &MeasuredFile, cell: &Cell) -> StrandInput {
    strand(file, cell, 60.0, (None, None, None))
}

/// A level strand; `told` is speed in mm/s, bead in mm and flow in mm³/s, the cell's where absent.
fn strand(
    file: &MeasuredFile,
    cell: &Cell,
    length_mm: f64,
    told: (Option<f64>, Option<f64>, Option<f64>),
) -> StrandInput {
    let (speed_mm_s, diameter_mm, flow_mm3_s) = told;
    let speed_m_s = speed_mm_s.map_or(cell.extruder.speed_m_s, |speed| speed / 1e3);
    let diameter_m = diameter_mm.map_or(cell.extruder.diameter_m, |diameter| diameter / 1e3);
    StrandInput {
        fidelity: Fidelity::ClosedForms,
        length_m: length_mm / 1e3,
        span_m: length_mm / 1e3,
        speed_m_s,
        flow_m3_s: flow_mm3_s.map_or(flow_m3_s(diameter_m, speed_m_s), |flow| flow / 1e9),
        nozzle_diameter_m: cell.tool.orifice_m,
        swell: cell.extruder.swell,
        gravity_across_m_s2: cell.gravity_m_s2.norm(),
        // Each print says its own.
        ends: Ends::BothHeld,
        mixer_m3: cell.extruder.mixer_m3.unwrap_or(0.0),
        dwell_s: 0.0,
        air: Air {
            blown: None,
            temperature_k: file.air.air_c + 273.15,
            room_m_s: file.air.air_m_s,
            jet: cell.tool.air_jet,
        },
        light: cell.tool.light_ring,
    }
}
