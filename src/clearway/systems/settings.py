"""What is wrong with the choice of a system or one of its settings."""


class SettingsError(ValueError):
    """A system or setting that does not exist or does not fit; names key, value and mend."""

    def __init__(self, key: str, value: object, mend: str) -> None:
        self.key, self.value, self.mend = key, value, mend
        super().__init__(f"{key}: got {value!r}; {mend}")
