// A few words next to the pointer.

export class Label {
  private readonly element = document.createElement("div");

  constructor(private readonly place: HTMLElement) {
    this.element.className = "pointer-label";
    this.element.dataset.testid = "pointer-label";
    place.append(this.element);
  }

  set(event: PointerEvent, text: string): void {
    const box = this.place.getBoundingClientRect();
    this.element.textContent = text;
    this.element.style.transform = `translate(${event.clientX - box.left + 14}px, ${event.clientY - box.top + 10}px)`;
  }

  remove(): void {
    this.element.remove();
  }
}
