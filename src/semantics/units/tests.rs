use super::*;
use proptest::prelude::*;

fn shown(text: &str) -> String {
    parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}")).to_string()
}

#[test]
fn units_have_their_dimensions() {
    for (text, dimension) in [
        ("kg m^2/s", "kg m² s⁻¹"),
        ("kg·m²·s⁻¹", "kg m² s⁻¹"),
        ("N m s", "kg m² s⁻¹"),
        ("m/s^2", "m s⁻²"),
        ("m/s/s", "m s⁻²"),
        ("m s-2", "m s⁻²"),
        ("m2", "m²"),
        ("J/(kg K)", "m² s⁻² K⁻¹"),
        ("1/s", "s⁻¹"),
        ("rpm", "s⁻¹"),
        ("kg^(1/2) m^{3/2}", "kg^(1/2) m^(3/2)"),
        ("rad", "1"),
        ("deg", "1"),
        ("%", "1"),
        ("1", "1"),
        ("arcsec/yr", "s⁻¹"),
        ("au^3/day^2", "m³ s⁻²"),
        ("mV", "kg m² s⁻³ A⁻¹"),
        ("µT", "kg s⁻² A⁻¹"),
        ("kΩ", "kg m² s⁻³ A⁻²"),
        ("Myr", "s"),
    ] {
        assert_eq!(shown(text), dimension, "{text}");
    }
}

/// Where a name could be a prefix and a shorter name, it is the unit of that name.
#[test]
fn names_go_before_prefixes() {
    for (text, dimension) in
        [("min", "s"), ("cd", "cd"), ("Pa", "kg m⁻¹ s⁻²"), ("h", "s"), ("T", "kg s⁻² A⁻¹"), ("mol", "mol"), ("d", "s")]
    {
        assert_eq!(shown(text), dimension, "{text}");
    }
}

#[test]
fn errors_teach() {
    let messages: Vec<String> =
        ["kgg", "", "kg m^", "kg/(m s", "J/kg K", "m^1000", "m^(1/0)", "furlong", "kg + m", "m/", "Hzz", "M", "2 m"]
            .map(|text| {
                let error = parse(text).unwrap_err();
                let at = &text[error.span.clone()];
                format!("{text:?}: {} at {at:?}; {}", error.message, error.help.unwrap_or_default())
            })
            .into();
    insta::assert_snapshot!(messages.join("\n"));
}

fn dimension() -> impl Strategy<Value = Dimension> {
    proptest::array::uniform7((-20_i128..=20, 1_i128..=6))
        .prop_map(|e| Dimension::with_exponents(e.map(|(n, d)| crate::expr::ratio::reduce(n, d).unwrap())))
}

proptest! {
    #[test]
    fn what_is_printed_reads_back_as_itself(d in dimension()) {
        prop_assert_eq!(parse(&d.to_string()), Ok(d));
    }

    #[test]
    fn a_product_of_units_has_the_product_of_their_dimensions(a in dimension(), b in dimension()) {
        let text = format!("{a} ({b})");
        prop_assert_eq!(parse(&text).ok(), a.times(&b));
        let text = format!("{a}/({b})");
        prop_assert_eq!(parse(&text).ok(), a.over(&b));
    }

    #[test]
    fn nothing_that_is_typed_panics(text in "[kgmsANJ°%Ω0-9^(){}/·* ⁻²−-]{0,40}") {
        if let Err(e) = parse(&text) {
            prop_assert!(text.get(e.span.clone()).is_some(), "{:?} is no place in {:?}", e.span, text);
        }
    }
}
