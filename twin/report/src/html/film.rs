//! Pictures of the part, the film strip, and the bar with the time slider.

use super::album::{Album, EmbeddedPicture, PictureKind};
use super::course::{Course, moment};
use super::name;
use crate::quantity::counted;

/// Hero picture and film strip; empty without pictures.
pub(super) fn body(album: &Album<'_>, course: &Course) -> String {
    let hero = album
        .first(&PictureKind::Hero)
        .map_or(String::new(), |picture| figure("hero", picture, "The finished part in its cell."));
    let strip: Vec<(f64, &EmbeddedPicture)> = album.strip().collect();
    format!("{hero}{}", strip_list(&strip, course))
}

fn strip_list(strip: &[(f64, &EmbeddedPicture)], course: &Course) -> String {
    if strip.is_empty() {
        return String::new();
    }
    let items: String = strip
        .iter()
        .map(|(time_s, picture)| {
            let share = 100.0 * course.share(*time_s);
            format!(
                "<li data-time=\"{time_s}\"><figure>{}<figcaption>{} · {share:.0} %</figcaption></figure></li>",
                picture.img(),
                moment(Some(*time_s))
            )
        })
        .collect();
    format!(
        "<h3>Film strip</h3><p class=\"soft js-only\">Choose a picture to go to its time.</p>\
         <ol class=\"strip\" tabindex=\"0\" aria-label=\"Film strip, {}\">{items}</ol>",
        counted(strip.len(), "picture")
    )
}

/// A picture with its caption, both escaped.
pub(super) fn figure(class: &str, picture: &EmbeddedPicture, caption: &str) -> String {
    format!(
        "<figure class=\"{class}\">{}<figcaption>{caption}</figcaption></figure>",
        picture.img()
    )
}

/// Spin maps, one for each strand that has one.
pub(super) fn spin_maps(album: &Album<'_>) -> String {
    let maps: String = album
        .spin_maps()
        .map(|(strand, picture)| {
            figure("map", picture, &format!("Strand {}: orientations along it.", name(strand)))
        })
        .collect();
    match maps.is_empty() {
        true => String::new(),
        false => format!(
            "<p>Which turns of the tool about its axis a strand could have been printed with, along its length.</p>\
             <div class=\"maps\">{maps}</div>"
        ),
    }
}

/// The bar at the lower edge: time for all parts of the page. Only where a script runs.
pub(super) fn bar(course: &Course) -> String {
    if !(course.total_s > 0.0) {
        return String::new();
    }
    let total_s = course.total_s;
    let step_s = total_s / 2000.0;
    format!(
        "<aside class=\"time-bar js-only\" aria-label=\"Time of the program\">\
         <input type=\"range\" id=\"slider\" aria-label=\"Time of the program\" min=\"0\" max=\"{total_s}\" \
         step=\"{step_s}\" value=\"{total_s}\"/>\
         <p id=\"now\"><b id=\"now-time\"></b> <span id=\"now-state\"></span></p></aside>\n"
    )
}
