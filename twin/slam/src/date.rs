//! Calendar dates as ISO 8601 writes them.

/// Whether a text is a day of the Gregorian calendar, `YYYY-MM-DD`. Such texts sort as their days do.
pub fn is_date(text: &str) -> bool {
    let bytes = text.as_bytes();
    let shaped = bytes.len() == 10
        && bytes.iter().enumerate().all(|(at, byte)| match at {
            4 | 7 => *byte == b'-',
            _ => byte.is_ascii_digit(),
        });
    if !shaped {
        return false;
    }
    let number = |digits: &[u8]| {
        digits.iter().fold(0_u32, |number, digit| 10 * number + u32::from(digit - b'0'))
    };
    let (year, month, day) = (number(&bytes[..4]), number(&bytes[5..7]), number(&bytes[8..]));
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let days = match month {
        1 | 3 | 5 | 7 | 8 | 10 | 12 => 31,
        4 | 6 | 9 | 11 => 30,
        2 if leap => 29,
        2 => 28,
        _ => 0,
    };
    (1..=days).contains(&day)
}

#[cfg(test)]
mod tests {
    use super::is_date;

    #[test]
    fn days_of_the_calendar_and_no_others() {
        for day in ["2027-01-31", "2024-02-29", "2000-02-29", "1999-12-31", "0000-01-01"] {
            assert!(is_date(day), "{day}");
        }
        for none in [
            "",
            "2027-02-29",
            "1900-02-29",
            "2027-04-31",
            "2027-13-01",
            "2027-00-01",
            "2027-01-00",
            "2027-1-31",
            "27-01-31",
            "2027/01/31",
            "2027-01-31T",
            " 2027-01-3",
            "20é7-01-31",
            "２０２７-01-31",
            "+027-01-31",
            "tomorrow",
        ] {
            assert!(!is_date(none), "{none}");
        }
    }

    #[test]
    fn a_century_has_as_many_days_as_four_hundred_years_say() {
        let days = (1900..2300)
            .flat_map(|year| {
                (0..100).flat_map(move |month| (0..100).map(move |day| (year, month, day)))
            })
            .filter(|(year, month, day)| is_date(&format!("{year}-{month:02}-{day:02}")))
            .count();
        assert_eq!(days, 146_097);
    }
}
