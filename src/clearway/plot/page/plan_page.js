// What the page of a plan shows beside the replay.

function makeContent(player, choose, go) {
  const gantt = new Gantt(byId("gantt"), player, choose);
  showLegend(byId("legend"));
  showFigures(byId("figures"));
  showCost(byId("cost"));
  showApart(byId("apart"), go);
  showWork(byId("work"), choose, go);
  return {
    show: (time, chosen) => gantt.show(time, chosen),
    drawUnder: () => {},
    drawOver: () => {},
    showsLoad: () => false,
    api: {},
  };
}
